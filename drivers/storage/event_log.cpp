#include "drivers/storage/event_log.hpp"

#include <cerrno>
#include <fcntl.h>

#include "base/file_result.hpp"
#include "base/files.hpp"

namespace azimuth {

FileResult<EventLogReader> EventLogReader::open(const std::filesystem::path& file) {
  FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  return EventLogReader(*std::move(mapped));
}

FileResult<EventLogWriter> EventLogWriter::create(const std::filesystem::path& file) {
  UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd) return failure(system_error(file, "cannot be written", errno));
  return EventLogWriter(std::move(fd));
}

EventLogWriter::EventLogWriter(UniqueFd fd) : fd_(std::move(fd)) { buffer_.reserve(2 * kBufferSize); }

EventLogWriter::~EventLogWriter() { static_cast<void>(flush()); }

std::error_code EventLogWriter::write(std::int64_t utime_us, std::string_view channel, Bytes data) {
  if (channel.empty() || channel.size() > kMaxChannelLength || data.size() > kMaxEventData) {
    return std::make_error_code(std::errc::invalid_argument);
  }
  append_event(buffer_, {static_cast<std::int64_t>(events_++), utime_us, channel, data});
  ++waiting_events_;
  return buffer_.size() < kBufferSize ? std::error_code{} : flush();
}

std::error_code EventLogWriter::flush() {
  const int error = write_all(fd_.get(), buffer_);
  if (error == 0) {
    whole_size_ += buffer_.size();
  } else {
    lost_events_ += waiting_events_;
    if (::ftruncate(fd_.get(), static_cast<off_t>(whole_size_)) == 0) {
      ::lseek(fd_.get(), static_cast<off_t>(whole_size_), SEEK_SET);
    }  // otherwise a part of an event stays in the file, and readers skip it
  }
  waiting_events_ = 0;
  buffer_.clear();
  return {error, std::generic_category()};
}

std::error_code EventLogWriter::sync() {
  if (const std::error_code error = flush()) return error;
  return {::fdatasync(fd_.get()) == 0 ? 0 : errno, std::generic_category()};
}

}  // namespace azimuth
