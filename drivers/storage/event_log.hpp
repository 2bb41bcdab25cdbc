#pragma once
// LCM event logs as files.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/file_result.hpp"
#include "base/files.hpp"
#include "base/unique_fd.hpp"
#include "drivers/wire/event_codec.hpp"

namespace azimuth {

/// Reads a log file of any size. Thread contract: thread-bound.
class EventLogReader {
 public:
  static FileResult<EventLogReader> open(const std::filesystem::path& file);

  /// The next complete event, which borrows from the reader. None at the end.
  std::optional<LogEvent> next() { return scanner_.next(); }

  /// Position in the file of the data of an event from this reader.
  std::uint64_t offset_of(const LogEvent& event) const {
    return static_cast<std::uint64_t>(event.data.data() - file_.bytes().data());
  }

  /// Number of bytes skipped so far, see EventScanner.
  std::uint64_t damaged_bytes() const { return scanner_.damaged_bytes(); }

 private:
  explicit EventLogReader(MappedFile file) : file_(std::move(file)), scanner_(file_.bytes()) {}

  MappedFile file_;
  EventScanner scanner_;
};

/// Writes a log file. Events reach the file complete and in order, in pieces of at least kBufferSize. A partial event
/// caused by a full disk is removed again, so that the file ends with a complete event and writing can be tried again.
/// Thread contract: thread-bound. write() allocates only for an event larger than kBufferSize.
class EventLogWriter {
 public:
  /// Creates the file, or empties it.
  static FileResult<EventLogWriter> create(const std::filesystem::path& file);
  EventLogWriter(EventLogWriter&&) = default;
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(EventLogWriter&&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;
  /// Flushes. Call flush() before to get errors.
  ~EventLogWriter();

  /// Appends an event and numbers it. std::errc::invalid_argument: the event was refused because its lengths exceed the
  /// limits of event_codec.hpp. Any other error comes from the file; the event is then lost, with all events buffered
  /// since the last flush.
  std::error_code write(std::int64_t utime_us, std::string_view channel, Bytes data);

  /// Passes everything to the kernel, so that it survives any end of this process.
  std::error_code flush();

  /// Flushes, and waits until the disk holds the data, so that they survive a loss of power. May take seconds.
  std::error_code sync();

  /// Number of events that write() accepted.
  std::uint64_t events() const { return events_; }
  /// Number of accepted events that were lost because of an error of the file.
  std::uint64_t lost() const { return lost_events_; }
  /// Size of the log [bytes], including buffered bytes.
  std::uint64_t size() const { return whole_size_ + buffer_.size(); }
  /// The descriptor of the file, only for locks and queries.
  int descriptor() const { return fd_.get(); }

  static constexpr std::size_t kBufferSize = 64 * 1024;

 private:
  explicit EventLogWriter(UniqueFd fd);

  UniqueFd fd_;
  std::vector<std::byte> buffer_;
  std::uint64_t whole_size_ = 0;  // size of the file up to the last complete event
  std::uint64_t events_ = 0, waiting_events_ = 0, lost_events_ = 0;
};

}  // namespace azimuth
