#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace azimuth {

/// The segments in a recording folder, of which the oldest can be deleted to make room. Other files are neither counted
/// nor touched. A segment that another process is recording is not deleted; the process holds a lock on it (see
/// Segment).
///
/// Thread contract: thread-bound.
class Archive {
 public:
  /// With a `part`, only the segments in the folder of that name within each session.
  explicit Archive(std::filesystem::path folder, std::filesystem::path part = {})
      : folder_(std::move(folder)), part_(std::move(part)) {}

  /// Reads the folder again. The segments of `own_session` (name of a folder, may be empty) count as the youngest, and
  /// the last of them is never deleted: a disk without room for two segments is too full for recording. `open_segment`
  /// is not included.
  void scan(const std::string& own_session, const std::filesystem::path& open_segment);

  std::uint64_t bytes() const { return bytes_; }

  /// Deletes the oldest segment that is not in use, and folders of its session that become empty. False: no segment can
  /// be deleted.
  bool delete_oldest();

 private:
  struct Closed {
    std::filesystem::path file;
    std::uint64_t bytes;
  };
  void scan_session(const std::filesystem::path& session, const std::filesystem::path& open_segment);

  std::filesystem::path folder_, part_;
  std::deque<Closed> closed_;  // oldest first
  // Total size of closed_ and of the segments that could not be deleted.
  std::uint64_t bytes_ = 0;
};

/// The name of a session that starts now, in UTC: "2026-11-21T13-05-00Z".
std::string session_name_now();

/// Bytes that an unprivileged process may still write to the file system that holds `path`, or will hold it once it is
/// created. None: the system does not tell.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& path);

}  // namespace azimuth
