#pragma once
// Reads the bytes of a run's frames on demand.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "drivers/storage/run.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Larger files are not accepted as frames.
inline constexpr std::size_t kMaxFrameFileBytes = std::size_t{256} << 20U;

/// Reads frames as they were recorded: separate files, or parts of a log.
///
/// Thread contract: thread-bound. Storage is kept between frames; a log stays mapped while its frames are read.
class FrameReader {
 public:
  /// The paths of frame files are relative to `folder`.
  explicit FrameReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The view is valid until the next call. The format of a file is reported as JPEG even for a PNG file (see
  /// is_png()). Its sides are those in its message or header, or 0 if there are none. Without bytes: the frame cannot
  /// be read, and problem() tells why.
  ImageView read(const FrameFile& frame);

  /// The cause of the last failure; empty when the last call succeeded.
  const std::string& problem() const { return problem_; }

 private:
  ImageView read_file(const FrameFile& frame);
  ImageView read_part(const FrameFile& frame, const FramePart& part);
  bool map(const std::filesystem::path& log);

  std::filesystem::path folder_, mapped_;
  std::unique_ptr<MappedFile> log_;
  std::vector<std::byte> file_;
  std::string problem_;
};

}  // namespace azimuth
