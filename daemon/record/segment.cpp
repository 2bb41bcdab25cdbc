#include "daemon/record/segment.hpp"

#include <cerrno>
#include <sys/file.h>
#include <sys/stat.h>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
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

}  // namespace azimuth
