#pragma once
// JPEG images to pixels and back, in memory: the images that cameras send as mjpeg and that run folders hold.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth {

/// The properties in the header of a JPEG image.
struct JpegHeader {
  int width_px = 0;
  int height_px = 0;
  bool coloured = false;  ///< false: grey only
  friend bool operator==(const JpegHeader&, const JpegHeader&) = default;

  /// The format that holds the image without loss: rgb8, or gray8 for a grey image.
  PixelFormat natural_format() const { return coloured ? PixelFormat::rgb8 : PixelFormat::gray8; }
};

/// Larger images are refused, because a header of a few bytes must not cost gigabytes. 8K video fits.
inline constexpr int kMaxJpegPixels = 1 << 25;

/// Decodes JPEG images, one after the other. Any input is safe. An image that is recognisably truncated or damaged is
/// refused as a whole. Harmless deviations of cameras are accepted: padding bytes before restart markers and the end, a
/// missing end marker, a second start marker, and any bytes between headers or after the end. The same bytes always
/// give the same pixels.
///
/// Thread contract: thread-bound. Storage is kept between images; libjpeg allocates working memory (some rows of the
/// image) for each image.
class JpegDecoder {
 public:
  JpegDecoder();

  /// None when there is no header, a side exceeds kMaxFrameSide_px, the image exceeds kMaxJpegPixels, or its colours
  /// are neither grey, RGB nor YCbCr.
  std::optional<JpegHeader> read_header(std::span<const std::byte> jpeg);

  /// Fills `pixels` with the image, with rows according to `format`, which must be valid, gray8, rgb8 or bgr8, and of
  /// the image's size. A grey image gives grey colours; gray8 takes the brightness of a coloured image. False: refused,
  /// and `pixels` may hold a part of the image.
  bool decode_into(std::span<const std::byte> jpeg, const FrameFormat& format, std::span<std::byte> pixels);

  /// Decodes into the decoder's own storage, without padding; valid until the next call. Without bytes: refused.
  ImageView decode(std::span<const std::byte> jpeg, PixelFormat pixels);

  /// The frame in a form for perception and people: compressed frames are decoded to `pixels`, others are returned
  /// unchanged.
  ImageView uncompressed(const ImageView& frame, PixelFormat pixels) {
    return frame.format.pixels == PixelFormat::mjpeg ? decode(frame.bytes, pixels) : frame;
  }

  /// Why the last call refused the image, in a few words.
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

  /// `image` must be readable gray8, rgb8 or bgr8, no larger than kMaxJpegPixels; `quality` is 1 to 100. The JPEG file
  /// is valid until the next call. Empty: the image does not meet these conditions.
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
