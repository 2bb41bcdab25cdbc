#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/bytes.hpp"
#include "daemon/record/archive.hpp"
#include "daemon/record/segment.hpp"

namespace azimuth {

/// How a log is. Counters count since the start.
struct RecorderStatus {
  bool on = false;                       ///< events reach a file
  std::string reason;                    ///< why not; empty while on
  std::string file;                      ///< the segment being written, or the last one
  std::uint64_t bytes = 0;               ///< recorded, in all segments
  std::uint64_t kept_bytes = 0;          ///< on the disk, of all sessions, by the last flush
  std::uint64_t quota_bytes = 0;         ///< for those; 0: none
  std::uint64_t events = 0;              ///< likewise; documents are not counted
  std::uint64_t lost_events = 0;         ///< given to the recorder, but in no file
  std::uint64_t segments_deleted = 0;    ///< old ones, to make room
  std::optional<std::uint64_t> free_mb;  ///< on the disk, when last asked; unknown until then
};

/// Where a log is written, and how much of the disk is its own. Megabytes are 10^6 bytes.
struct LogSpace {
  std::filesystem::path folder;     ///< of all sessions
  std::filesystem::path part = {};  ///< of a session, in which the segments lie; empty: the session's folder itself
  std::filesystem::path yields_first = {};  ///< part of every session whose segments go before ours when a disk is full
  double max_file_mb = 0.0;                 ///< as in RecordSettings, likewise the rest
  double max_file_age_s = 0.0;
  double quota_mb = 0.0;
  double min_free_mb = 0.0;
  double flush_interval_s = 0.0;
};

/// Events in LCM's log format, in segments of a session folder (drivers/storage/session.hpp).
///
/// What survives: everything up to the last flush is in the kernel's hands and survives the end of the process by any
/// means. A loss of power may cost what the kernel has not written to the disk yet, usually the last half minute; only
/// closing a segment forces it there.
///
/// A disk that is full, gone or read-only stops the log, nothing else: it is logged once, events are counted as lost,
/// and writing is tried again in a new segment, ever more seldom (up to every 30 s). The process must ignore SIGXFSZ if
/// files may be limited in size (RLIMIT_FSIZE).
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). While a segment is being
/// written nothing allocates once storage has grown.
class SegmentedLog {
 public:
  using Clock = std::chrono::steady_clock;

  /// `documents` begin every segment, on the documents' channel with `channel_prefix`.
  SegmentedLog(LogSpace space, std::vector<Document> documents, std::string channel_prefix);
  /// Closes the segment, and removes folders of this session that stayed empty.
  ~SegmentedLog();
  SegmentedLog(SegmentedLog&&) = default;
  SegmentedLog(const SegmentedLog&) = delete;
  SegmentedLog& operator=(SegmentedLog&&) = delete;
  SegmentedLog& operator=(const SegmentedLog&) = delete;

  /// Begins the first segment at once. With a `session` of that name, which another log has begun, the log becomes a
  /// part of that, else it begins one of its own. Its documents are of `utime_us`.
  void begin(const std::string& session, std::int64_t utime_us);

  /// Before begin() every event is lost.
  void write(std::string_view channel, Bytes data, std::int64_t utime_us);
  /// Counts an event that could not even be given to write().
  void lose() { ++status_.lost_events; }

  /// Does what is due: flush, next segment, making room, another try. To be called several times a flush interval.
  void turn(Clock::time_point now);

  const RecorderStatus& status() const { return status_; }
  /// Name of the session's folder; empty until that is made.
  const std::string& session() const { return session_; }

 private:
  enum class Room { enough, none };

  void begin_first_turn(Clock::time_point now);
  void open_segment();
  std::filesystem::path session_folder() const { return space_.folder / session_ / space_.part; }
  std::error_code make_session_folder();
  std::error_code claim_session();
  void next_segment();
  std::error_code close_segment();
  void check(const std::error_code& error);
  void check_disk();
  Room make_room(double floor_factor, std::uint64_t more_bytes = 0);
  bool delete_oldest(bool for_quota);
  bool over_quota(std::uint64_t more_bytes) const;
  bool under_floor(double floor_factor);
  bool is_full() const;
  void account();
  void stop(const std::string& reason);
  void stop_at_floor();

  LogSpace space_;
  std::vector<Document> documents_;
  std::string channel_prefix_;
  Archive archive_, yielding_;
  std::string session_;
  bool begun_ = false;
  std::optional<Segment> segment_;
  RecorderStatus status_;
  std::uint64_t next_segment_ = 0;
  std::uint64_t bytes_before_ = 0, counted_lost_ = 0;  // of earlier segments; of this one, in status_ already
  std::int64_t last_utime_us_ = 0;
  std::optional<Clock::time_point> now_;  // of the last turn
  Clock::time_point began_{}, flushed_{}, checked_{}, next_try_{};
  Clock::time_point recording_since_{};
  Clock::duration pause_{};
};

}  // namespace azimuth
