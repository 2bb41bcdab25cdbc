#pragma once
// The images of a recorded run, one at a time.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/png.hpp"
#include "drivers/storage/frame_reader.hpp"
#include "drivers/storage/run.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Reads the frames of a run one at a time, so that a run needs the memory of only one image.
///
/// A view is valid until the next call. A view without bytes means that the frame cannot be read, and problem() tells
/// why. Thread contract: thread-bound. Storage is kept between images.
class RunImages {
 public:
  /// Borrows the run, which must not change.
  explicit RunImages(const Run& run) : run_(run), reader_(run.folder) {}

  std::size_t count() const { return run_.frames.size(); }

  /// The frame as it was recorded. Of a JPEG image only the header is read. A PNG image is returned as pixels, without
  /// loss, because neither messages nor cameras use PNG.
  ImageView recorded(std::size_t index);

  /// The frame as perception reads it: compressed frames are decoded to `decoded`, which is gray8, rgb8 or bgr8.
  ImageView pixels(std::size_t index, PixelFormat decoded);

  /// The file and the cause of the last failure; empty when the last call succeeded.
  const std::string& problem() const { return problem_; }

 private:
  ImageView read(std::size_t index);
  ImageView decode_png(std::size_t index, std::span<const std::byte> png, std::optional<PixelFormat> decoded);
  ImageView refuse(std::size_t index, const std::string& why);

  const Run& run_;
  FrameReader reader_;
  JpegDecoder jpeg_;
  PngDecoder png_;
  std::string problem_;
};

}  // namespace azimuth
