#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/bytes.hpp"
#include "base/file_result.hpp"
#include "daemon/record/archive.hpp"
#include "drivers/storage/event_log.hpp"
#include "drivers/storage/session.hpp"

namespace azimuth {

/// The segment being recorded: an LCM log that starts with the documents. While it is open, a lock protects it against
/// deletion by other recorders.
///
/// Thread contract: thread-bound.
class Segment {
 public:
  /// Creates the file in an existing folder and writes the documents to it. A file that could not be completed is
  /// removed. `channel_prefix` comes before the documents' channel, `utime_us` is the time of the documents.
  static FileResult<Segment> create(const std::filesystem::path& file, const SegmentMark& mark,
                                    std::span<const Document> documents, std::string_view channel_prefix,
                                    std::int64_t utime_us);

  EventLogWriter& log() { return log_; }
  const EventLogWriter& log() const { return log_; }
  const std::filesystem::path& file() const { return file_; }
  /// Size of the documents at the start [bytes].
  std::uint64_t documents_size() const { return documents_size_; }
  /// True: the file was deleted, so data written to it are lost.
  bool is_deleted() const;

 private:
  Segment(EventLogWriter log, std::filesystem::path file) : log_(std::move(log)), file_(std::move(file)) {}
  std::error_code write_documents(const SegmentMark& mark, std::span<const Document> documents,
                                  std::string_view channel_prefix, std::int64_t utime_us);

  EventLogWriter log_;
  std::filesystem::path file_;
  std::uint64_t documents_size_ = 0;
};

/// The state of a log. Counters count since the start.
struct RecorderStatus {
  bool on = false;                       ///< events are written to a file
  std::string reason;                    ///< why no events are written; empty while `on`
  std::string file;                      ///< the segment being written, or the last one
  std::uint64_t bytes = 0;               ///< bytes recorded in all segments
  std::uint64_t kept_bytes = 0;          ///< bytes of all sessions on the disk at the last flush
  std::uint64_t quota_bytes = 0;         ///< limit of kept_bytes; 0: none
  std::uint64_t events = 0;              ///< events recorded in all segments, without documents
  std::uint64_t lost_events = 0;         ///< events given to the recorder that are in no file
  std::uint64_t segments_deleted = 0;    ///< old segments deleted to make room
  std::optional<std::uint64_t> free_mb;  ///< free space on the disk when last checked; none: not checked yet
};

/// The folder of a log, and the disk space that the log may use. A megabyte is 10^6 bytes.
struct LogSpace {
  std::filesystem::path folder;  ///< folder of all sessions
  /// Folder within a session that holds the segments; empty: the session's folder itself.
  std::filesystem::path part = {};
  /// Folder within every session whose segments are deleted before this log's own when the disk is full.
  std::filesystem::path yields_first = {};
  double max_file_mb = 0.0;  ///< this and the following members are as in RecordSettings
  double max_file_age_s = 0.0;
  double quota_mb = 0.0;
  double min_free_mb = 0.0;
  double flush_interval_s = 0.0;
};

/// A log of events in LCM's log format, in segments of a session folder (drivers/storage/session.hpp).
///
/// Data up to the last flush are with the kernel and survive any end of the process. A loss of power may cost the data
/// that the kernel has not yet written to the disk, usually those of the last half minute; only closing a segment
/// forces them to the disk.
///
/// A disk that is full, missing or read-only stops only the log. The trouble is logged once, and events are counted as
/// lost. Writing is tried again in a new segment, at growing intervals (up to 30 s). The process must ignore SIGXFSZ if
/// file sizes may be limited (RLIMIT_FSIZE).
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). While a segment is being
/// written, nothing allocates once the storage has grown.
class SegmentedLog {
 public:
  using Clock = std::chrono::steady_clock;

  /// Every segment starts with `documents`, on the documents' channel with `channel_prefix`.
  SegmentedLog(LogSpace space, std::vector<Document> documents, std::string channel_prefix);
  /// Closes the segment, and removes folders of this session that stayed empty.
  ~SegmentedLog();
  SegmentedLog(SegmentedLog&&) = default;
  SegmentedLog(const SegmentedLog&) = delete;
  SegmentedLog& operator=(SegmentedLog&&) = delete;
  SegmentedLog& operator=(const SegmentedLog&) = delete;

  /// Starts the first segment at once. With a nonempty `session`, which another log has started, this log becomes a
  /// part of that session; otherwise it starts a session of its own. `utime_us` is the time of the documents.
  void begin(const std::string& session, std::int64_t utime_us);

  /// Writes one event. Before begin() every event is lost.
  void write(std::string_view channel, Bytes data, std::int64_t utime_us);
  /// Counts an event as lost that could not be given to write().
  void lose() { ++status_.lost_events; }

  /// Does everything that is due: flush, start the next segment, make room, try again after trouble. To be called
  /// several times per flush interval.
  void turn(Clock::time_point now);

  const RecorderStatus& status() const { return status_; }
  /// Name of the session's folder; empty until the folder exists.
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
  // Bytes of earlier segments; lost events of this segment that are already counted in status_.
  std::uint64_t bytes_before_ = 0, counted_lost_ = 0;
  std::int64_t last_utime_us_ = 0;
  std::optional<Clock::time_point> now_;  // time of the last turn
  Clock::time_point began_{}, flushed_{}, checked_{}, next_try_{};
  Clock::time_point recording_since_{};
  Clock::duration pause_{};
};

}  // namespace azimuth
