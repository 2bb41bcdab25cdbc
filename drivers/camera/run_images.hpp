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

/// Reads the frames of a run, each when it is asked for, so that a run needs the memory of one image.
///
/// A view is valid until the next call. One without bytes: the frame cannot be read, and problem() says why.
/// Thread contract: thread-bound. Storage is kept from image to image.
class RunImages {
 public:
  /// Borrows the run, which must not change meanwhile.
  explicit RunImages(const Run& run) : run_(run), reader_(run.folder) {}

  std::size_t count() const { return run_.frames.size(); }

  /// The frame as it was recorded; of a JPEG image only the header has been looked at. PNG, which neither messages nor
  /// cameras have, comes as pixels, without loss.
  ImageView recorded(std::size_t index);

  /// The frame as perception reads it: compressed ones are decoded to `decoded`, gray8, rgb8 or bgr8.
  ImageView pixels(std::size_t index, PixelFormat decoded);

  /// Of the last call: file and reason; empty when it succeeded.
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
