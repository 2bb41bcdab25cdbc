#pragma once
// JPEG images to pixels and back, on bytes: what cameras send as mjpeg and what run folders keep.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth {

/// What a JPEG image says of itself before any pixel.
struct JpegHeader {
  int width_px = 0;
  int height_px = 0;
  bool coloured = false;  ///< false: brightness only
  friend bool operator==(const JpegHeader&, const JpegHeader&) = default;

  /// Without loss of what is there: rgb8, or gray8 for an image of brightness only.
  PixelFormat natural_format() const { return coloured ? PixelFormat::rgb8 : PixelFormat::gray8; }
};

/// Larger images are refused: a header of a few bytes must not cost gigabytes. 8K video fits.
inline constexpr int kMaxJpegPixels = 1 << 25;

/// Decodes JPEG images, one after the other. Any bytes are safe; an image that is cut short or damaged is refused as a
/// whole, as far as the damage shows in it. What cameras do without losing a pixel does no harm: a few bytes of padding
/// before restart markers and the end, no end marker, a start marker too many, anything between headers or after the
/// image's end. Same bytes, same pixels.
///
/// Thread contract: thread-bound. Storage is kept from image to image; libjpeg's own working memory, some rows of the
/// image, comes and goes with each.
class JpegDecoder {
 public:
  JpegDecoder();

  /// Nothing when there is no header, a side is beyond kMaxFrameSide_px, the image is larger than kMaxJpegPixels, or
  /// its colours are neither grey, RGB nor YCbCr.
  std::optional<JpegHeader> read_header(std::span<const std::byte> jpeg);

  /// Fills `pixels` with the image, rows as `format` says, which must be gray8, rgb8 or bgr8, valid, and of the image's
  /// size; a grey image makes grey colours, and of a coloured one gray8 takes the brightness. False: refused, and
  /// `pixels` may hold a part of the image.
  bool decode_into(std::span<const std::byte> jpeg, const FrameFormat& format, std::span<std::byte> pixels);

  /// The same into storage of the decoder's, without padding; valid until the next call. No bytes: refused.
  ImageView decode(std::span<const std::byte> jpeg, PixelFormat pixels);

  /// A frame as perception and people look at it: compressed ones are decoded to `pixels`, all others are as they are.
  ImageView uncompressed(const ImageView& frame, PixelFormat pixels) {
    return frame.format.pixels == PixelFormat::mjpeg ? decode(frame.bytes, pixels) : frame;
  }

  /// Why the last call refused, in a few words.
  const std::string& problem() const { return problem_; }

 private:
  struct Library;
  struct Destroy {
    void operator()(Library* library) const;
  };
  bool read(std::span<const std::byte> jpeg, JpegHeader& header);
  bool refuse(const char* why);  // always false
  bool refuse_damaged();

  std::unique_ptr<Library, Destroy> library_;
  std::vector<std::byte> pixels_;
  std::string problem_;
};

/// Encodes images as baseline JPEG, colours at full resolution.
///
/// Thread contract: thread-bound. Storage is kept from image to image.
class JpegEncoder {
 public:
  JpegEncoder();

  /// `image` is gray8, rgb8 or bgr8 and readable, no larger than kMaxJpegPixels; `quality` 1 to 100. The file is valid
  /// until the next call. Empty: refused, the image is none of that.
  std::span<const std::byte> encode(const ImageView& image, int quality);

 private:
  struct Library;
  struct Destroy {
    void operator()(Library* library) const;
  };

  std::unique_ptr<Library, Destroy> library_;
  std::vector<std::byte> file_;
};

}  // namespace azimuth
