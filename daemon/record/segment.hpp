#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "base/file_result.hpp"
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

}  // namespace azimuth
