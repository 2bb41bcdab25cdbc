#include "tools/log_index/find_logs.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "drivers/storage/session.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

bool is_log_name(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".lcmlog" || extension == ".lcm" || extension == ".log";
}

std::int64_t nanoseconds_of(fs::file_time_type time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// Adds a file to a log. A file that a recorder deletes in the meantime is ignored.
void add_file(FoundLog& log, std::uint64_t& bytes, const fs::path& file) {
  std::error_code no_size, no_time;
  const std::uintmax_t size = fs::file_size(file, no_size);
  const fs::file_time_type time = fs::last_write_time(file, no_time);
  if (no_size || no_time) return;
  bytes += size;
  log.changed_ns = log.files == 0 ? nanoseconds_of(time) : std::max(log.changed_ns, nanoseconds_of(time));
}

class Search {
 public:
  explicit Search(fs::path top) : top_(std::move(top)) {}

  FoundLogs run() && {
    look_into(top_);
    std::ranges::sort(found_.logs, {}, &FoundLog::path);
    return std::move(found_);
  }

 private:
  void look_into(const fs::path& folder) {
    const std::vector<SegmentFile> segments = session_segments(folder);
    if (!segments.empty()) add_session(folder, segments);
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      std::error_code ignored;
      const fs::path name = entry->path().filename();
      const bool link = entry->is_symlink(ignored);
      if (entry->is_directory(ignored)) {
        if (!link && !(name == kFramesPart && !segments.empty())) look_into(entry->path());
      } else if (is_log_name(name) && !segment_number(name.string()) && entry->is_regular_file(ignored)) {
        add_log(entry->path());
      }
    }
    if (error) found_.unreadable.push_back(system_error(folder.string(), "cannot be searched", error.value()));
  }
  void add_session(const fs::path& folder, const std::vector<SegmentFile>& segments) {
    FoundLog log;
    log.path = relative(folder);
    for (const SegmentFile& segment : segments) {
      add_file(log, log.bytes, segment.file);
      ++log.files;
    }
    for (const SegmentFile& segment : session_segments(folder / kFramesPart))
      add_file(log, log.image_bytes, segment.file);
    found_.logs.push_back(std::move(log));
  }
  void add_log(const fs::path& file) {
    FoundLog log;
    log.path = relative(file);
    add_file(log, log.bytes, file);
    log.files = 1;
    found_.logs.push_back(std::move(log));
  }
  std::string relative(const fs::path& path) const { return path.lexically_relative(top_).string(); }

  fs::path top_;
  FoundLogs found_;
};

}  // namespace

FoundLogs find_logs(const fs::path& folder) { return Search(folder).run(); }

}  // namespace azimuth
