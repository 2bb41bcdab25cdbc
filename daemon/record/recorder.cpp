#include "daemon/record/recorder.hpp"

#include <algorithm>
#include <cerrno>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <utility>

#include "drivers/io/channels.hpp"
#include "drivers/io/messages.hpp"

namespace azimuth {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr auto kDiskInterval = 1s;  // between two looks at the disk
constexpr Recorder::Clock::duration kFirstPause = 1s, kLongestPause = 30s;
constexpr double kFloorToResume = 1.05;           // times the floor, so that recording does not go on and off
constexpr int kDeletionsAtOnce = 8;               // keeps a turn short
constexpr double kSegmentsInQuota = 4.0;          // at least: or the quota would leave next to nothing of the past
constexpr std::uint64_t kDocumentsInSegment = 4;  // a segment is at least this many times its documents
constexpr std::size_t kTypicalMessage = 64 * 1024;

std::uint64_t bytes(double megabytes) { return static_cast<std::uint64_t>(megabytes * 1e6); }

Recorder::Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Recorder::Clock::duration>(std::chrono::duration<double>(value));
}

}  // namespace

Recorder::Recorder(RecordSettings settings, std::vector<Document> documents)
    : settings_(std::move(settings)),
      documents_(std::move(documents)),
      odometry_channel_(settings_.channel_prefix + std::string(channel::kOdometry)),
      bearings_channel_(settings_.channel_prefix + std::string(channel::kBearings)),
      features_channel_(settings_.channel_prefix + std::string(channel::kFeatures)),
      archive_(settings_.folder) {
  if (settings_.folder.empty()) {
    status_.reason = "no folder is configured";
    return;
  }
  bearings_message_.bearings.reserve(kTypicalBearings);
  data_.reserve(kTypicalMessage);
  last_utime_us_ =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  open_segment();
}

Recorder::~Recorder() {
  static_cast<void>(close_segment());
  std::error_code ignored;
  if (!session_.empty()) fs::remove(fs::path(settings_.folder) / session_, ignored);  // refused unless it is empty
}

void Recorder::odometry(const OdometryReading& reading) {
  if (settings_.folder.empty()) return;
  encode(to_message(reading), data_);
  write(odometry_channel_, data_, to_us(reading.stamp));
}

void Recorder::bearings(const BearingSet& set) {
  if (settings_.folder.empty()) return;
  const bool plain = is_plain(set);
  if (plain) {
    fill_message(set, bearings_message_);
    encode(bearings_message_, data_);
  } else {
    fill_message(set, features_message_);
    encode(features_message_, data_);
  }
  write(plain ? bearings_channel_ : features_channel_, data_, to_us(set.stamp));
}

/// Samples reach the recorder as such, and again as echoes on their channels.
bool Recorder::is_sample_channel(std::string_view channel) const {
  return channel == odometry_channel_ || channel == bearings_channel_ || channel == features_channel_;
}

void Recorder::message(std::string_view channel, Bytes data, std::int64_t utime_us) {
  if (settings_.folder.empty() || is_sample_channel(channel)) return;
  write(channel, data, utime_us);
}

void Recorder::write(std::string_view channel, Bytes data, std::int64_t utime_us) {
  last_utime_us_ = utime_us;
  if (segment_ && is_full()) next_segment();
  if (!segment_) {
    ++status_.lost_events;
    return;
  }
  ++status_.events;
  const std::error_code error = segment_->log().write(utime_us, channel, data);
  if (error == std::errc::invalid_argument) {  // nothing the format can hold; the file is as good as before
    --status_.events;
    ++status_.lost_events;
    return;
  }
  check(error);
}

bool Recorder::is_full() const {
  double limit_mb = settings_.max_file_mb;
  if (settings_.quota_mb > 0.0) limit_mb = std::min(limit_mb, settings_.quota_mb / kSegmentsInQuota);
  return segment_->log().size() >= std::max(bytes(limit_mb), kDocumentsInSegment * segment_->documents_size());
}

void Recorder::turn(Clock::time_point now) {
  if (settings_.folder.empty()) return;
  if (!now_) begin_first_turn(now);
  now_ = now;
  if (!segment_) {
    if (now >= next_try_) open_segment();
    return;
  }
  if (now - flushed_ >= seconds(settings_.flush_interval_s)) {
    flushed_ = now;
    const std::error_code error = segment_->log().flush();
    account();
    check(error);
  }
  if (segment_ && now - checked_ >= kDiskInterval) check_disk();
  if (segment_ && now - began_ >= seconds(settings_.max_file_age_s)) next_segment();
}

/// What began before there was a time begins now.
void Recorder::begin_first_turn(Clock::time_point now) {
  began_ = flushed_ = checked_ = recording_since_ = next_try_ = now;
}

void Recorder::open_segment() {
  if (now_) began_ = flushed_ = checked_ = *now_;
  archive_.scan(session_, {});
  if (make_room(status_.reason.empty() ? 1.0 : kFloorToResume) == Room::none) return stop_at_floor();
  if (const std::error_code error = make_session_folder())
    return stop(
        fmt::format("{}: cannot be made: {}", (fs::path(settings_.folder) / session_).string(), error.message()));
  const fs::path file = fs::path(settings_.folder) / session_ / segment_name(next_segment_);
  FileResult<Segment> segment =
      Segment::create(file, {next_segment_, status_.lost_events}, documents_, settings_.channel_prefix, last_utime_us_);
  if (!segment) return stop(segment.errors().front().text());
  segment_.emplace(*std::move(segment));
  ++next_segment_;
  bytes_before_ = status_.bytes;
  counted_lost_ = 0;
  status_.file = file.string();
  if (!status_.on) {
    spdlog::info("recording to {}", status_.file);
    if (now_) recording_since_ = *now_;
  }
  status_.on = true;
  status_.reason.clear();
  account();
}

/// The session's folder is named once; somebody may remove it while it is in use.
std::error_code Recorder::make_session_folder() {
  std::error_code error;
  fs::create_directories(settings_.folder, error);
  if (error) return error;
  if (!session_.empty()) {
    fs::create_directory(fs::path(settings_.folder) / session_, error);
    return error;
  }
  const std::string name = session_name_now();
  std::string unused = name;
  for (int number = 2; ::mkdir((fs::path(settings_.folder) / unused).c_str(), 0755) != 0; ++number) {
    if (errno != EEXIST) return {errno, std::generic_category()};
    unused = fmt::format("{}-{}", name, number);
  }
  session_ = unused;
  return {};
}

void Recorder::next_segment() {
  if (const std::error_code error = close_segment()) return check(error);
  open_segment();
}

std::error_code Recorder::close_segment() {
  if (!segment_) return {};
  const std::error_code error = segment_->log().sync();
  account();
  segment_.reset();
  return error;
}

/// Takes the outcome of writing.
void Recorder::check(const std::error_code& error) {
  if (error) stop(fmt::format("{}: cannot be written: {}", status_.file, error.message()));
}

/// Brings the counters up to what the segment says.
void Recorder::account() {
  const EventLogWriter& log = segment_->log();
  const std::uint64_t lost = log.lost() - std::exchange(counted_lost_, log.lost());
  status_.bytes = bytes_before_ + log.size();
  status_.events -= lost;
  status_.lost_events += lost;
}

void Recorder::stop(const std::string& reason) {
  if (segment_) {
    static_cast<void>(segment_->log().flush());  // there may be room for what waits
    account();
    segment_.reset();
  }
  if (status_.reason.empty()) spdlog::warn("recording stopped: {}; tried again from time to time", reason);
  const Clock::time_point now = now_.value_or(Clock::time_point{});
  // After a good while the first retry comes at once: making room may be all it takes.
  const bool went_well = status_.on && now - recording_since_ > kLongestPause;
  pause_ = went_well ? 0s : std::clamp(2 * pause_, kFirstPause, kLongestPause);
  next_try_ = now + pause_;
  status_.on = false;
  status_.reason = reason;
}

void Recorder::stop_at_floor() {
  stop(fmt::format("less than {:.0f} MB are free on the disk of {}", settings_.min_free_mb, settings_.folder));
}

void Recorder::check_disk() {
  checked_ = *now_;
  if (segment_->is_deleted()) {
    spdlog::warn("{} was deleted while it was recorded; going on in the next segment", status_.file);
    return next_segment();
  }
  if (make_room(1.0) == Room::none) stop_at_floor();
}

/// Deletes old segments as long as the quota or the floor asks for it. Only the floor can forbid to record.
Recorder::Room Recorder::make_room(double floor_factor) {
  for (int i = 0; i < kDeletionsAtOnce && (over_quota() || under_floor(floor_factor)); ++i) {
    if (!archive_.delete_oldest()) break;
    ++status_.segments_deleted;
  }
  return under_floor(floor_factor) ? Room::none : Room::enough;
}

bool Recorder::over_quota() const {
  const std::uint64_t open = segment_ ? segment_->log().size() : 0;
  return settings_.quota_mb > 0.0 && archive_.bytes() + open > bytes(settings_.quota_mb);
}

bool Recorder::under_floor(double floor_factor) {
  const std::optional<std::uint64_t> free = free_bytes(settings_.folder);
  status_.free_mb = free ? std::optional(*free / 1'000'000) : std::nullopt;
  return free && static_cast<double>(*free) < floor_factor * 1e6 * settings_.min_free_mb;
}

}  // namespace azimuth
