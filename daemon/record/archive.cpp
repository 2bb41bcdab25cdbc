#include "daemon/record/archive.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <string_view>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/storage/session.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

/// Sorts sessions: the start of a session, and its number among the sessions of the same second.
using SessionKey = std::pair<std::string, unsigned>;

constexpr std::string_view kPattern = "dddd-dd-ddTdd-dd-ddZ";

/// None: the name is not that of a session.
std::optional<SessionKey> session_key(std::string_view name) {
  const auto fits = [](char c, char pattern) { return pattern == 'd' ? c >= '0' && c <= '9' : c == pattern; };
  const std::string_view start = name.substr(0, kPattern.size());
  if (!std::ranges::equal(start, kPattern, fits)) return std::nullopt;
  std::string_view rest = name.substr(kPattern.size());
  if (rest.empty()) return SessionKey(start, 1);
  if (!rest.starts_with('-')) return std::nullopt;
  rest.remove_prefix(1);
  unsigned number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc{} || end != rest.data() + rest.size()) return std::nullopt;
  return SessionKey(start, number);
}

/// True: a process is recording into the file.
bool in_use(const fs::path& file) {
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  return fd && ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

void Archive::scan(const std::string& own_session, const fs::path& open_segment) {
  std::vector<std::pair<SessionKey, fs::path>> others;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const auto key = session_key(name);
    if (key && name != own_session) others.emplace_back(*key, entry->path());
  }
  std::ranges::sort(others);
  closed_.clear();
  bytes_ = 0;
  for (const auto& [key, session] : others) scan_session(session / part_, open_segment);
  const std::size_t segments_of_others = closed_.size();
  if (!own_session.empty()) scan_session(folder_ / own_session / part_, open_segment);
  if (closed_.size() > segments_of_others) closed_.pop_back();  // bytes_ still includes it
}

void Archive::scan_session(const fs::path& session, const fs::path& open_segment) {
  for (SegmentFile& segment : session_segments(session)) {
    if (segment.file == open_segment) continue;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(segment.file, error);
    if (error) continue;  // the file was deleted meanwhile
    closed_.push_back({std::move(segment.file), size});
    bytes_ += size;
  }
}

bool Archive::delete_oldest() {
  while (!closed_.empty()) {
    const Closed oldest = std::move(closed_.front());
    closed_.pop_front();
    std::error_code error, ignored;
    if (in_use(oldest.file)) continue;
    const bool deleted = fs::remove(oldest.file, error);
    if (error) continue;
    bytes_ -= oldest.bytes;
    if (!deleted) continue;  // another process deleted it
    const fs::path within = oldest.file.parent_path();
    fs::remove(within, ignored);  // fails while the folder contains anything
    if (!part_.empty()) fs::remove(within.parent_path(), ignored);
    return true;
  }
  return false;
}

std::string session_name_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H-%M-%SZ}", fmt::gmtime(now));
}

std::optional<std::uint64_t> free_bytes(const fs::path& path) {
  struct statvfs disk {};
  std::error_code error;
  fs::path existing = fs::absolute(path, error);
  while (::statvfs(existing.c_str(), &disk) != 0) {
    if (errno != ENOENT || !existing.has_relative_path()) return std::nullopt;
    existing = existing.parent_path();
  }
  return std::uint64_t{disk.f_bavail} * disk.f_frsize;
}

}  // namespace azimuth
