#include "daemon/keep/map_keeper.hpp"

#include <algorithm>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "base/clocks.hpp"
#include "daemon/journal/journal.hpp"
#include "drivers/device/device_clock.hpp"
#include "drivers/storage/map_file.hpp"

namespace azimuth {
namespace {

/// Pauses between maps. kSoon applies when only a new map would let a restart know the pose, kAgain after such a map
/// could not be written.
constexpr MapKeeper::Clock::duration kSoon = std::chrono::seconds(1), kAgain = std::chrono::seconds(3);

/// When the file was last modified [us since the Unix epoch]; 0: it does not exist.
std::int64_t written_us(const std::string& file) {
  struct stat about {};
  if (file.empty() || ::stat(file.c_str(), &about) != 0) return 0;
  return std::chrono::floor<std::chrono::microseconds>(from_timespec(about.st_mtim)).count();
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

MapKeeper::MapKeeper(MapSettings settings, MapKeeperStatus start, bool saves, std::optional<OdometryKeeper> odometry)
    : settings_(std::move(settings)), status_(std::move(start)), saves_(saves), odometry_(std::move(odometry)) {
  status_.written_us = written_us(settings_.file);
}

bool MapKeeper::is_due(Clock::time_point now) {
  if ((!saves_ && !odometry_) || settings_.save_interval_s <= 0.0) return false;
  const auto interval = clock_duration(settings_.save_interval_s);
  if (!asked_) {
    asked_ = now;
    head_start_ = std::min(age_of_saved(), due_soon());
  }
  const auto waited = now - *asked_;
  const bool way_is_unknown = odometry_ && !odometry_->knows_way();
  const bool is_urgent = way_is_unknown && waited >= (status_.trouble ? kAgain : kSoon);
  if (waited + head_start_ < interval && !is_urgent) return false;
  asked_ = now;
  head_start_ = {};
  return true;
}

/// A head start that leaves only kSoon of the save interval.
MapKeeper::Clock::duration MapKeeper::due_soon() const {
  return std::max(clock_duration(settings_.save_interval_s) - kSoon, Clock::duration{});
}

/// Uses the disk's clock, which may have been set meanwhile. Without a map, or with one from the future, the age is
/// zero.
MapKeeper::Clock::duration MapKeeper::age_of_saved() const {
  if (status_.written_us == 0) return {};
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::max(Clock::duration(since_epoch - std::chrono::microseconds(status_.written_us)), Clock::duration{});
}

bool MapKeeper::save(const MapSnapshot& map) {
  if (map.landmarks.empty()) {
    head_start_ = due_soon();
    return false;
  }
  if (!saves_) return save_place(map);
  const std::string problem = write(map, settings_.file);
  if (problem.empty()) {
    if (status_.trouble || status_.saved == 0)
      log_event(JournalEvent::map_saved, "the map is saved to " + settings_.file);
    ++status_.saved;
    status_.written_us = written_us(settings_.file);
    status_.text = fmt::format("{}: saved with {} landmarks", settings_.file, map.landmarks.size());
    status_.trouble = false;
  } else {
    if (problem != status_.text) log_event(JournalEvent::map_trouble, "the map is not saved: " + problem);
    ++status_.failed;
    status_.text = problem;
    status_.trouble = true;
  }
  return problem.empty();
}

/// The file may lie where the daemon cannot write. This does not harm the map; only a restart then needs a
/// relocalisation.
bool MapKeeper::save_place(const MapSnapshot& map) {
  if (!odometry_) return false;
  const std::string problem = write(map, located_map(settings_.file).string());
  if (!problem.empty() && !place_trouble_)
    log_event(JournalEvent::map_trouble, "where the robot is is not kept for a restart: " + problem);
  place_trouble_ = !problem.empty();
  return problem.empty();
}

/// Returns why the map was not written; empty: it was written.
std::string MapKeeper::write(const MapSnapshot& map, const std::string& file) {
  if (encoded_size(map) > kMaxMapBytes) return file + ": the map has grown too large to be saved";
  if (const auto problem = implausible(map)) return file + ": the map " + *problem;
  encode(map, bytes_);
  if (saves_ && status_.unfit) {
    if (const auto aside = set_map_aside(file); !aside) return aside.error().front().text();
    status_.unfit = false;
  }
  const std::uint32_t checksum = map_checksum(bytes_);
  if (odometry_) odometry_->map_comes(map.stamp, checksum);
  if (const auto written = write_map(bytes_, file); !written) return written.error().front().text();
  if (odometry_) odometry_->map_is(map.stamp, checksum);
  return {};
}

}  // namespace azimuth
