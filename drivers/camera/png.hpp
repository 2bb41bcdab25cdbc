#pragma once
// PNG images to pixels and back, in memory: the format in run folders of other programs.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth {

/// The properties in the header of a PNG image.
struct PngHeader {
  int width_px = 0;
  int height_px = 0;
  bool coloured = false;  ///< false: grey only
  friend bool operator==(const PngHeader&, const PngHeader&) = default;

  /// The format that holds the image without loss (except for 16-bit samples): rgb8, or gray8 for a grey image.
  PixelFormat natural_format() const { return coloured ? PixelFormat::rgb8 : PixelFormat::gray8; }
};

/// Larger images are refused, as for JPEG.
inline constexpr int kMaxPngPixels = 1 << 25;

/// True: PNG can hold these pixels without loss: gray8, rgb8 and bgr8.
bool png_holds(PixelFormat pixels);
/// Encodes an image of such pixels, with fast rather than strong compression; empty when libpng refuses it. Thread
/// contract: reentrant.
std::vector<std::byte> encode_png(const ImageView& image);

/// Decodes PNG images of any depth, including palettes and interlaced images, one after the other. Samples of up to 8
/// bits are kept; of 16-bit samples the upper half is used; transparent pixels are put on black. Any input is safe. A
/// truncated or damaged image is refused as a whole. Bytes after the pixels are ignored. The same bytes always give the
/// same pixels.
///
/// Thread contract: thread-bound. Storage is kept between images; libpng allocates working memory for each image.
class PngDecoder {
 public:
  /// None when there is no header, a side exceeds kMaxFrameSide_px, or the image exceeds kMaxPngPixels.
  std::optional<PngHeader> read_header(std::span<const std::byte> png);

  /// The image as gray8, rgb8 or bgr8, with rows without padding; valid until the next call. A grey image gives grey
  /// colours; gray8 takes the brightness of a coloured image, as for JPEG. Without bytes: refused.
  ImageView decode(std::span<const std::byte> png, PixelFormat pixels);

  /// Why the last call refused the image, in a few words.
  const std::string& problem() const { return problem_; }

 private:
  std::vector<std::byte> pixels_;
  std::string problem_;
};

}  // namespace azimuth
