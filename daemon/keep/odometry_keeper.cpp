#include "daemon/keep/odometry_keeper.hpp"

#include <algorithm>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>
#include <utility>

#include "base/clocks.hpp"

namespace azimuth {

StampClock stamp_clock(Duration epoch_minus_monotonic) {
  StampClock clock{.boot = {}, .asleep = {}, .epoch_minus_monotonic = epoch_minus_monotonic};
  std::ifstream("/proc/sys/kernel/random/boot_id") >> clock.boot;
  const Duration since_boot = now_on(CLOCK_BOOTTIME);
  clock.asleep = since_boot - now_on(CLOCK_MONOTONIC);
  return clock;
}

OdometryKeeper::OdometryKeeper(const std::filesystem::path& map, StampClock clock) : file_(kept_odometry_file(map)) {
  kept_.clock = std::move(clock);
  std::optional<Stamp> newest;
  const KeptRecords left = read_kept_odometry(file_);
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (!left[i]) continue;
    records_[i] = {left[i]->map_checksum, left[i]->odometer.origin};
    const auto kept = on_clock(*left[i], kept_.clock);
    if (!kept || (newest && kept->since.reading.stamp < *newest)) continue;
    newest = kept->since.reading.stamp;
    newest_ = i;
  }
}

void OdometryKeeper::map_is(Stamp stamp, std::uint32_t checksum) {
  map_ = {stamp, checksum};
  const auto is_of_it = [&](std::size_t i) { return records_[i] && records_[i]->map_checksum == checksum; };
  if (!is_of_it(newest_) && is_of_it(other())) newest_ = other();
}

void OdometryKeeper::map_comes(Stamp stamp, std::uint32_t checksum) { put({stamp, checksum}); }

void OdometryKeeper::odometer_is(const OdometerMemory& memory) {
  kept_.odometer = memory;
  knows_odometer_ = true;
  const auto is_of_another = [&](const auto& record) { return record && record->origin != memory.origin; };
  if (std::ranges::any_of(records_, is_of_another)) forget();
}

void OdometryKeeper::robot_went(const OdometryWays& ways) {
  ways_ = ways;
  if (!ways.since_map && !ways.since_made_map) forget();
}

void OdometryKeeper::write() {
  if (map_ && put(*map_)) newest_ = other();
}

/// Null: the motion is unknown.
const OdometrySince* OdometryKeeper::way_since(Stamp map) const {
  for (const auto* way : {&ways_.since_made_map, &ways_.since_map})
    if (*way && (*way)->map == map) return &**way;
  return nullptr;
}

/// Overwrites the older record in a single call, so that a killed process leaves a whole record or none. False: the
/// record was not written, and the newest record is unchanged.
bool OdometryKeeper::put(const MapName& map) {
  const OdometrySince* const way = way_since(map.stamp);
  if (!way || !knows_odometer_ || way->reading.origin != kept_.odometer.origin) return false;
  kept_.since = *way;
  if (!fd_) fd_ = UniqueFd(::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  if (!fd_) return false;
  kept_.map_checksum = map.checksum;
  encode(kept_, bytes_);
  const auto size = static_cast<ssize_t>(bytes_.size());
  if (::pwrite(fd_.get(), bytes_.data(), bytes_.size(), static_cast<off_t>(other()) * size) != size) return false;
  records_[other()] = {map.checksum, kept_.odometer.origin};
  return true;
}

/// Overwrites in place, because a full disk has no room for a file that is truncated and grows again.
void OdometryKeeper::forget() {
  if (!records_[0] && !records_[1]) return;
  if (!fd_) fd_ = UniqueFd(::open(file_.c_str(), O_WRONLY | O_CLOEXEC));
  encode(kept_, bytes_);
  bytes_.assign(records_.size() * bytes_.size(), std::byte{});
  const auto size = static_cast<ssize_t>(bytes_.size());
  const bool overwritten = fd_ && ::pwrite(fd_.get(), bytes_.data(), bytes_.size(), 0) == size;
  if (overwritten || ::truncate(file_.c_str(), 0) == 0) records_ = {};
}

}  // namespace azimuth
