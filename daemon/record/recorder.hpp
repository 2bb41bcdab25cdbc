#pragma once
#include <azimuth/bearings_t.hpp>
#include <azimuth/features_t.hpp>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "daemon/record/archive.hpp"
#include "daemon/record/record_settings.hpp"
#include "daemon/record/segment.hpp"
#include "drivers/io/event_codec.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// How the recording is. Counters count since the start.
struct RecorderStatus {
  bool on = false;                       ///< events reach a file
  std::string reason;                    ///< why not; empty while on
  std::string file;                      ///< the segment being written, or the last one
  std::uint64_t bytes = 0;               ///< recorded, in all segments
  std::uint64_t events = 0;              ///< likewise; documents are not counted
  std::uint64_t lost_events = 0;         ///< given to the recorder, but in no file
  std::uint64_t segments_deleted = 0;    ///< old ones, to make room
  std::optional<std::uint64_t> free_mb;  ///< on the disk, when last asked; unknown until then
};

/// Records what the estimator was given and what the daemon published, in LCM's log format, into segments of a session
/// folder (drivers/io/session.hpp): FOLDER/2026-11-21T13-05-00Z/000.lcm and so on.
///
/// What survives: everything up to the last flush is in the kernel's hands and survives the end of the process by any
/// means. A loss of power may cost what the kernel has not written to the disk yet, usually the last half minute; only
/// closing a segment forces it there.
///
/// A disk that is full, gone or read-only stops the recording, nothing else: it is logged once, events are counted as
/// lost, and recording is tried again in a new segment, ever more seldom (up to every 30 s). The process must ignore
/// SIGXFSZ if files may be limited in size (RLIMIT_FSIZE).
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). While a segment is being
/// written nothing allocates once storage has grown.
class Recorder {
 public:
  using Clock = std::chrono::steady_clock;

  /// Begins the first segment at once. `documents` begin every segment; a rig.toml among them makes it replayable.
  Recorder(RecordSettings settings, std::vector<Document> documents);
  /// Closes the segment.
  ~Recorder();
  Recorder(Recorder&&) = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(Recorder&&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // In the order in which the estimator takes them. Their stamps are the events' times.
  void odometry(const OdometryReading& reading);
  void bearings(const BearingSet& set);

  /// A message published on `channel` (with the prefix); `utime_us` on the clock of the stamps. Odometry and bearings
  /// sent on our own channels are left out: they are recorded as the estimator takes them.
  void message(std::string_view channel, Bytes data, std::int64_t utime_us);

  /// Does what is due: flush, next segment, making room, another try. To be called several times a flush interval.
  void turn(Clock::time_point now);

  const RecorderStatus& status() const { return status_; }

 private:
  enum class Room { enough, none };

  void write(std::string_view channel, Bytes data, std::int64_t utime_us);
  void begin_first_turn(Clock::time_point now);
  void open_segment();
  std::error_code make_session_folder();
  void next_segment();
  std::error_code close_segment();
  void check(const std::error_code& error);
  void check_disk();
  Room make_room(double floor_factor);
  bool over_quota() const;
  bool under_floor(double floor_factor);
  bool is_sample_channel(std::string_view channel) const;
  bool is_full() const;
  void account();
  void stop(const std::string& reason);
  void stop_at_floor();

  RecordSettings settings_;
  std::vector<Document> documents_;
  std::string odometry_channel_, bearings_channel_, features_channel_;
  Archive archive_;
  std::string session_;  // name of its folder; empty until that is made
  std::optional<Segment> segment_;
  RecorderStatus status_;
  std::uint64_t next_segment_ = 0;
  std::uint64_t bytes_before_ = 0, counted_lost_ = 0;  // of earlier segments; of this one, in status_ already
  std::int64_t last_utime_us_ = 0;
  std::optional<Clock::time_point> now_;  // of the last turn
  Clock::time_point began_{}, flushed_{}, checked_{}, next_try_{};
  Clock::time_point recording_since_{};
  Clock::duration pause_{};
  bearings_t bearings_message_{};
  features_t features_message_{};
  std::vector<std::byte> data_;
};

}  // namespace azimuth
