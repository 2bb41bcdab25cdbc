#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace azimuth {

/// The segments that lie in a recording folder, so that the oldest can make room. Whatever else lies there is neither
/// counted nor touched; nor is a segment deleted that another process is recording (it holds a lock on it, see
/// Segment).
///
/// Thread contract: thread-bound.
class Archive {
 public:
  /// With a `part`, the segments that lie in the folder of that name within each session.
  explicit Archive(std::filesystem::path folder, std::filesystem::path part = {})
      : folder_(std::move(folder)), part_(std::move(part)) {}

  /// Looks anew. Segments of `own_session` (a folder's name, may be empty) are the youngest, and the last of them is
  /// kept: a disk on which not even two have room is too full to record on. `open_segment` is left out altogether.
  void scan(const std::string& own_session, const std::filesystem::path& open_segment);

  std::uint64_t bytes() const { return bytes_; }

  /// Deletes the oldest segment that is not in use, and folders of its session that are empty then. False when there
  /// is none that can be deleted.
  bool delete_oldest();

 private:
  struct Closed {
    std::filesystem::path file;
    std::uint64_t bytes;
  };
  void scan_session(const std::filesystem::path& session, const std::filesystem::path& open_segment);

  std::filesystem::path folder_, part_;
  std::deque<Closed> closed_;  // oldest first
  std::uint64_t bytes_ = 0;    // of closed_, and of those that could not be deleted
};

/// "2026-11-21T13-05-00Z": the name of a session that starts now, in UTC.
std::string session_name_now();

/// Bytes a process without privileges may still write to the file system that holds `path`, or would hold it once it is
/// made. Nothing when the system does not say.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& path);

}  // namespace azimuth
