#pragma once
// PNG images to pixels and back, on bytes: what run folders of other programs keep.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth {

/// What a PNG image says of itself before any pixel.
struct PngHeader {
  int width_px = 0;
  int height_px = 0;
  bool coloured = false;  ///< false: brightness only
  friend bool operator==(const PngHeader&, const PngHeader&) = default;

  /// Without loss of what is there, but for samples of 16 bits: rgb8, or gray8 for an image of brightness only.
  PixelFormat natural_format() const { return coloured ? PixelFormat::rgb8 : PixelFormat::gray8; }
};

/// Larger images are refused, as of JPEG.
inline constexpr int kMaxPngPixels = 1 << 25;

/// Whether PNG has these pixels without loss: gray8, rgb8 and bgr8.
bool png_holds(PixelFormat pixels);
/// An image of such pixels, compressed quickly rather than well; empty when libpng refuses it. Thread contract:
/// reentrant.
std::vector<std::byte> encode_png(const ImageView& image);

/// Decodes PNG images, one after the other: any depth, palettes and interlaced ones too. Samples of 8 bits and less
/// come as they are; of 16 bits the upper half; what is transparent lies on black. Any bytes are safe; an image that
/// is cut short or damaged is refused as a whole. Bytes after its pixels do no harm. Same bytes, same pixels.
///
/// Thread contract: thread-bound. Storage is kept from image to image; libpng's own working memory comes and goes with
/// each.
class PngDecoder {
 public:
  /// Nothing when there is no header, a side is beyond kMaxFrameSide_px, or the image is larger than kMaxPngPixels.
  std::optional<PngHeader> read_header(std::span<const std::byte> png);

  /// The image as gray8, rgb8 or bgr8, rows without padding; valid until the next call. A grey image makes grey
  /// colours, and of a coloured one gray8 takes the brightness, as of JPEG. No bytes: refused.
  ImageView decode(std::span<const std::byte> png, PixelFormat pixels);

  /// Why the last call refused, in a few words.
  const std::string& problem() const { return problem_; }

 private:
  std::vector<std::byte> pixels_;
  std::string problem_;
};

}  // namespace azimuth
