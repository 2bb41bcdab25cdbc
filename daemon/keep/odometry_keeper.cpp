#include "daemon/keep/odometry_keeper.hpp"

#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>
#include <utility>

namespace azimuth {
namespace {

Duration now_on(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::chrono::duration_cast<Duration>(std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec));
}

}  // namespace

StampClock stamp_clock(Duration epoch_minus_monotonic) {
  StampClock clock{.boot = {}, .asleep = {}, .epoch_minus_monotonic = epoch_minus_monotonic};
  std::ifstream("/proc/sys/kernel/random/boot_id") >> clock.boot;
  const Duration since_boot = now_on(CLOCK_BOOTTIME);
  clock.asleep = since_boot - now_on(CLOCK_MONOTONIC);
  return clock;
}

OdometryKeeper::OdometryKeeper(const std::filesystem::path& map, StampClock clock) : file_(kept_odometry_file(map)) {
  kept_.clock = std::move(clock);
  ::unlink(file_.c_str());
}

void OdometryKeeper::map_is(Stamp stamp, std::uint32_t checksum) {
  map_ = stamp;
  kept_.map_checksum = checksum;
}

void OdometryKeeper::odometer_is(const OdometerMemory& memory) {
  kept_.odometer = memory;
  knows_odometer_ = true;
}

void OdometryKeeper::robot_went(const std::optional<OdometrySince>& since) {
  knows_way_ = since.has_value();
  if (since) kept_.since = *since;
  if (!since) forget();
}

/// In one call, so that a process that is killed leaves all of it or none.
void OdometryKeeper::write() {
  const bool belong_together =
      knows_way_ && knows_odometer_ && map_ == kept_.since.map && kept_.since.reading.origin == kept_.odometer.origin;
  if (!belong_together) return;
  if (!fd_) fd_ = UniqueFd(::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  encode(kept_, bytes_);
  if (fd_ && ::pwrite(fd_.get(), bytes_.data(), bytes_.size(), 0) == static_cast<ssize_t>(bytes_.size()))
    empty_ = false;
}

void OdometryKeeper::forget() {
  if (!std::exchange(empty_, true)) static_cast<void>(::ftruncate(fd_.get(), 0));
}

}  // namespace azimuth
