#pragma once
// The bytes of a run's frames, each when it is asked for.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "drivers/storage/run.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Larger files are no frames.
inline constexpr std::size_t kMaxFrameFileBytes = std::size_t{256} << 20U;

/// Reads frames as they were recorded, files of their own or parts of a log.
///
/// Thread contract: thread-bound. Storage is kept from frame to frame; a log stays mapped while its frames are read.
class FrameReader {
 public:
  /// `folder`: what the frames' files are relative to.
  explicit FrameReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Valid until the next call. A file is taken for a JPEG image, which has the sides that its message or its header
  /// claims, 0 when they claim none: also when it is_png(). No bytes: the frame cannot be read, and problem() says why.
  ImageView read(const FrameFile& frame);

  /// Of the last call; empty when it succeeded.
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
