#include "daemon/record/segmented_log.hpp"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <utility>

#include "base/clocks.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {

namespace fs = std::filesystem;

FileResult<Segment> Segment::create(const fs::path& file, const SegmentMark& mark, std::span<const Document> documents,
                                    std::string_view channel_prefix, std::int64_t utime_us) {
  FileResult<EventLogWriter> log = EventLogWriter::create(file);
  if (!log) return failure(log.error());
  Segment segment(*std::move(log), file);
  // A failure is ignored: on a file system without locks, recording works all the same. The lock only keeps other
  // recorders from deleting this file to make room.
  static_cast<void>(::flock(segment.log_.descriptor(), LOCK_EX | LOCK_NB));
  const std::error_code error = segment.write_documents(mark, documents, channel_prefix, utime_us);
  if (!error) return segment;
  std::error_code ignored;
  fs::remove(file, ignored);
  return failure(system_error(file, "cannot be written", error.value()));
}

std::error_code Segment::write_documents(const SegmentMark& mark, std::span<const Document> documents,
                                         std::string_view channel_prefix, std::int64_t utime_us) {
  const std::string channel = std::string(channel_prefix).append(channel::kDocument);
  std::vector<std::byte> data;
  const auto write = [&](std::string_view name, std::string_view text) {
    encode(to_message(name, text, stamp_from_us(utime_us)), data);
    return log_.write(utime_us, channel, data);
  };
  if (const auto error = write(kSegmentDocument, to_text(mark))) return error;
  for (const Document& document : documents) {
    if (document.of_the_start && mark.number > 0) continue;
    if (const auto error = write(document.name, document.text)) return error;
  }
  documents_size_ = log_.size();
  return log_.flush();
}

bool Segment::is_deleted() const {
  struct stat status {};
  return ::fstat(log_.descriptor(), &status) == 0 && status.st_nlink == 0;
}

using namespace std::chrono_literals;

namespace {

constexpr auto kDiskInterval = 1s;  // time between two checks of the disk
constexpr SegmentedLog::Clock::duration kFirstPause = 1s, kLongestPause = 30s;
// Recording resumes at this multiple of the floor, so that it does not stop and start repeatedly.
constexpr double kFloorToResume = 1.05;
constexpr int kDeletionsAtOnce = 8;               // keeps a turn short
constexpr double kSegmentsInQuota = 4.0;          // smallest number, so that deleting a segment keeps most of the past
constexpr std::uint64_t kDocumentsInSegment = 4;  // smallest ratio of a segment's size to that of its documents

std::uint64_t bytes(double megabytes) { return static_cast<std::uint64_t>(megabytes * 1e6); }

}  // namespace

SegmentedLog::SegmentedLog(LogSpace space, std::vector<Document> documents, std::string channel_prefix)
    : space_(std::move(space)),
      documents_(std::move(documents)),
      channel_prefix_(std::move(channel_prefix)),
      archive_(space_.folder, space_.part),
      yielding_(space_.folder, space_.yields_first) {}

SegmentedLog::~SegmentedLog() {
  static_cast<void>(close_segment());
  std::error_code ignored;
  if (session_.empty()) return;
  fs::remove(session_folder(), ignored);  // fails unless the folder is empty
  fs::remove(space_.folder / session_, ignored);
}

void SegmentedLog::begin(const std::string& session, std::int64_t utime_us) {
  session_ = session;
  last_utime_us_ = utime_us;
  begun_ = true;
  open_segment();
}

void SegmentedLog::write(std::string_view channel, Bytes data, std::int64_t utime_us) {
  last_utime_us_ = utime_us;
  if (segment_ && is_full()) next_segment();
  if (!segment_) return lose();
  if (over_quota(data.size())) make_room(1.0, data.size());
  ++status_.events;
  const std::error_code error = segment_->log().write(utime_us, channel, data);
  if (error == std::errc::invalid_argument) {  // the format cannot hold the event; the file is unchanged
    --status_.events;
    return lose();
  }
  check(error);
}

bool SegmentedLog::is_full() const {
  double limit_mb = space_.max_file_mb;
  if (space_.quota_mb > 0.0) limit_mb = std::min(limit_mb, space_.quota_mb / kSegmentsInQuota);
  return segment_->log().size() >= std::max(bytes(limit_mb), kDocumentsInSegment * segment_->documents_size());
}

void SegmentedLog::turn(Clock::time_point now) {
  if (!now_) begin_first_turn(now);
  now_ = now;
  if (!begun_) return;
  if (!segment_) {
    if (now >= next_try_) open_segment();
    return;
  }
  if (now - flushed_ >= clock_duration(space_.flush_interval_s)) {
    flushed_ = now;
    const std::error_code error = segment_->log().flush();
    account();
    check(error);
  }
  if (segment_ && now - checked_ >= kDiskInterval) check_disk();
  if (segment_ && now - began_ >= clock_duration(space_.max_file_age_s)) next_segment();
}

/// Starts all intervals, because the times are unknown before the first turn.
void SegmentedLog::begin_first_turn(Clock::time_point now) {
  began_ = flushed_ = checked_ = recording_since_ = next_try_ = now;
}

void SegmentedLog::open_segment() {
  if (now_) began_ = flushed_ = checked_ = *now_;
  archive_.scan(session_, {});
  if (make_room(status_.reason.empty() ? 1.0 : kFloorToResume) == Room::none) return stop_at_floor();
  if (const std::error_code error = make_session_folder())
    return stop(fmt::format("{}: cannot be made: {}", session_folder().string(), error.message()));
  const fs::path file = session_folder() / segment_name(next_segment_);
  FileResult<Segment> segment =
      Segment::create(file, {next_segment_, status_.lost_events}, documents_, channel_prefix_, last_utime_us_);
  if (!segment) return stop(segment.error().front().text());
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

/// The session is named only once. Its folder is created again if it was removed meanwhile.
std::error_code SegmentedLog::make_session_folder() {
  std::error_code error;
  fs::create_directories(space_.folder, error);
  if (!error && session_.empty()) error = claim_session();
  if (!error) fs::create_directories(session_folder(), error);
  return error;
}

std::error_code SegmentedLog::claim_session() {
  const std::string name = session_name_now();
  std::string unused = name;
  for (int number = 2; ::mkdir((space_.folder / unused).c_str(), 0755) != 0; ++number) {
    if (errno != EEXIST) return {errno, std::generic_category()};
    unused = fmt::format("{}-{}", name, number);
  }
  session_ = unused;
  return {};
}

void SegmentedLog::next_segment() {
  if (const std::error_code error = close_segment()) return check(error);
  open_segment();
}

std::error_code SegmentedLog::close_segment() {
  if (!segment_) return {};
  const std::error_code error = segment_->log().sync();
  account();
  segment_.reset();
  return error;
}

/// Stops the log if writing has failed.
void SegmentedLog::check(const std::error_code& error) {
  if (error) stop(fmt::format("{}: cannot be written: {}", status_.file, error.message()));
}

/// Updates the counters from the segment.
void SegmentedLog::account() {
  const EventLogWriter& log = segment_->log();
  const std::uint64_t lost = log.lost() - std::exchange(counted_lost_, log.lost());
  status_.bytes = bytes_before_ + log.size();
  status_.kept_bytes = archive_.bytes() + log.size();
  status_.quota_bytes = bytes(space_.quota_mb);
  status_.events -= lost;
  status_.lost_events += lost;
}

void SegmentedLog::stop(const std::string& reason) {
  if (segment_) {
    static_cast<void>(segment_->log().flush());  // there may be room for the buffered events
    account();
    segment_.reset();
  }
  if (status_.reason.empty()) spdlog::warn("recording stopped: {}; tried again from time to time", reason);
  const Clock::time_point now = now_.value_or(Clock::time_point{});
  // If the log ran well for a while, the first retry comes at once, because making room may be enough.
  const bool went_well = status_.on && now - recording_since_ > kLongestPause;
  pause_ = went_well ? 0s : std::clamp(2 * pause_, kFirstPause, kLongestPause);
  next_try_ = now + pause_;
  status_.on = false;
  status_.reason = reason;
}

void SegmentedLog::stop_at_floor() {
  stop(fmt::format("less than {:.0f} MB are free on the disk of {}", space_.min_free_mb, space_.folder.string()));
}

void SegmentedLog::check_disk() {
  checked_ = *now_;
  if (segment_->is_deleted()) {
    spdlog::warn("{} was deleted while it was recorded; going on in the next segment", status_.file);
    return next_segment();
  }
  if (make_room(1.0) == Room::none) stop_at_floor();
}

/// Deletes old segments while the quota (for `more_bytes` more) or the floor of free space requires it. Only the floor
/// can forbid recording.
SegmentedLog::Room SegmentedLog::make_room(double floor_factor, std::uint64_t more_bytes) {
  for (int i = 0; i < kDeletionsAtOnce; ++i) {
    const bool for_quota = over_quota(more_bytes);
    if (!for_quota && !under_floor(floor_factor)) break;
    if (!delete_oldest(for_quota)) break;
    ++status_.segments_deleted;
  }
  return under_floor(floor_factor) ? Room::none : Room::enough;
}

/// To meet the quota, only this log's own segments are deleted. On a full disk, the segments of `yields_first` go
/// first.
bool SegmentedLog::delete_oldest(bool for_quota) {
  if (!for_quota && !space_.yields_first.empty()) {
    yielding_.scan(session_, {});
    if (yielding_.delete_oldest()) return true;
  }
  return archive_.delete_oldest();
}

bool SegmentedLog::over_quota(std::uint64_t more_bytes) const {
  const std::uint64_t open = segment_ ? segment_->log().size() : 0;
  return space_.quota_mb > 0.0 && archive_.bytes() + open + more_bytes > bytes(space_.quota_mb);
}

bool SegmentedLog::under_floor(double floor_factor) {
  const std::optional<std::uint64_t> free = free_bytes(space_.folder);
  status_.free_mb = free ? std::optional(*free / 1'000'000) : std::nullopt;
  return free && static_cast<double>(*free) < floor_factor * 1e6 * space_.min_free_mb;
}

}  // namespace azimuth
