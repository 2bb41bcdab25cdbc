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

  /// The next whole event; borrows from the reader. Nothing at the end.
  std::optional<LogEvent> next() { return scanner_.next(); }

  /// Where the data of an event of this reader begins in the file.
  std::uint64_t offset_of(const LogEvent& event) const {
    return static_cast<std::uint64_t>(event.data.data() - file_.bytes().data());
  }

  /// Bytes skipped so far, see EventScanner.
  std::uint64_t damaged_bytes() const { return scanner_.damaged_bytes(); }

 private:
  explicit EventLogReader(MappedFile file) : file_(std::move(file)), scanner_(file_.bytes()) {}

  MappedFile file_;
  EventScanner scanner_;
};

/// Writes a log file. Events reach the file whole and in order, kBufferSize bytes or more at a time; what a full disk
/// cuts off is taken back, so that the file ends with a whole event and writing may be tried again.
/// Thread contract: thread-bound. write() allocates only for an event larger than kBufferSize.
class EventLogWriter {
 public:
  /// Makes the file, or empties it.
  static FileResult<EventLogWriter> create(const std::filesystem::path& file);
  EventLogWriter(EventLogWriter&&) = default;
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(EventLogWriter&&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;
  /// Flushes; call flush() first to learn of errors.
  ~EventLogWriter();

  /// Appends an event, numbered by the writer. Refused (std::errc::invalid_argument) when its lengths are beyond the
  /// limits of event_codec.hpp; otherwise an error is that of the file, and the event is lost with all that waited
  /// since the last flush.
  std::error_code write(std::int64_t utime_us, std::string_view channel, Bytes data);

  /// Hands everything to the kernel: from then on it survives the end of this process, however it ends.
  std::error_code flush();

  /// The same, and waits until the disk holds it: from then on it survives a loss of power. May take seconds.
  std::error_code sync();

  std::uint64_t events() const { return events_; }                     ///< accepted by write()
  std::uint64_t lost() const { return lost_events_; }                  ///< accepted, then lost to an error of the file
  std::uint64_t size() const { return whole_size_ + buffer_.size(); }  ///< bytes, those that wait included
  int descriptor() const { return fd_.get(); }                         ///< of the file, for locks and questions only

  static constexpr std::size_t kBufferSize = 64 * 1024;

 private:
  explicit EventLogWriter(UniqueFd fd);

  UniqueFd fd_;
  std::vector<std::byte> buffer_;
  std::uint64_t whole_size_ = 0;  // of the file, up to the last whole event
  std::uint64_t events_ = 0, waiting_events_ = 0, lost_events_ = 0;
};

}  // namespace azimuth
