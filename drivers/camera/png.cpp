#include "drivers/camera/png.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <png.h>
#include <string_view>

namespace azimuth {

namespace {

constexpr std::size_t kSignature = 8, kChunkFrame = 12;  // length, type and checksum

/// True: the pixels need this chunk. Texts, profiles and similar chunks can unpack to any size, and libpng unpacks all
/// of them.
bool is_needed(std::string_view type) {
  constexpr std::array<std::string_view, 6> kOfPixels{"tRNS", "gAMA", "cHRM", "sRGB", "sBIT", "bKGD"};
  const bool is_critical = type[0] >= 'A' && type[0] <= 'Z';
  return is_critical || std::ranges::find(kOfPixels, type) != kOfPixels.end();
}

/// Size of the chunk at the beginning of `rest`; a truncated chunk extends to the end.
std::size_t chunk_size(std::span<const std::byte> rest) {
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < 4 && i < rest.size(); ++i)
    length = length << 8U | std::to_integer<std::uint64_t>(rest[i]);
  return static_cast<std::size_t>(std::min<std::uint64_t>(length + kChunkFrame, rest.size()));
}

/// The image without the chunks that its pixels do not need: `png` itself, or a copy in `kept`.
std::span<const std::byte> only_pixels(std::span<const std::byte> png, std::vector<std::byte>& kept) {
  if (png.size() < kSignature) return png;
  kept.assign(png.begin(), png.begin() + kSignature);
  for (std::span<const std::byte> rest = png.subspan(kSignature); !rest.empty();) {
    const std::span<const std::byte> chunk = rest.first(chunk_size(rest));
    rest = rest.subspan(chunk.size());
    const bool has_type = chunk.size() >= kSignature;
    if (!has_type || is_needed({reinterpret_cast<const char*>(chunk.data()) + 4, 4}))
      kept.insert(kept.end(), chunk.begin(), chunk.end());
  }
  return kept.size() == png.size() ? png : kept;
}

/// libpng's view of one image. It frees what libpng allocated for the image.
class PngReader {
 public:
  PngReader() { image_.version = PNG_IMAGE_VERSION; }
  ~PngReader() { png_image_free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read_header(std::span<const std::byte> png) {
    png = only_pixels(png, kept_);
    if (png_image_begin_read_from_memory(&image_, png.data(), png.size()) == 0) return false;
    image_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // cameras scale all depths alike
    return true;
  }

  /// Reads the pixels in the order and number of samples of `format`. To be called after read_header().
  bool read_pixels(png_uint_32 format, std::span<std::byte> out) {
    constexpr png_color kBlack{0, 0, 0};
    image_.format = format;
    return png_image_finish_read(&image_, &kBlack, out.data(), 0, nullptr) != 0;
  }

  PngHeader header() const {
    return {static_cast<int>(image_.width), static_cast<int>(image_.height),
            (image_.format & PNG_FORMAT_FLAG_COLOR) != 0};
  }
  bool is_small_enough() const {
    constexpr auto kMaxSide_px = static_cast<png_uint_32>(kMaxFrameSide_px);
    return image_.width <= kMaxSide_px && image_.height <= kMaxSide_px &&
           image_.width * image_.height <= static_cast<png_uint_32>(kMaxPngPixels);
  }
  const char* message() const { return image_.message; }

 private:
  std::vector<std::byte> kept_;
  png_image image_{};
};

/// None when the image cannot be read, with the reason in `problem`.
std::optional<PngHeader> begin(PngReader& reader, std::span<const std::byte> png, std::string& problem) {
  problem.clear();
  if (png.empty())
    problem = "is empty";
  else if (!reader.read_header(png))
    problem = reader.message();
  else if (!reader.is_small_enough())
    problem = "is too large";
  return problem.empty() ? std::optional(reader.header()) : std::nullopt;
}

/// True: the brightness must be computed here, because libpng's brightness differs from that of JPEG.
bool becomes_brightness(const PngHeader& header, PixelFormat wanted) {
  return header.coloured && wanted == PixelFormat::gray8;
}

std::optional<png_uint_32> libpng_format(PixelFormat pixels) {
  switch (pixels) {
    case PixelFormat::gray8:
      return PNG_FORMAT_GRAY;
    case PixelFormat::rgb8:
      return PNG_FORMAT_RGB;
    case PixelFormat::bgr8:
      return PNG_FORMAT_BGR;
    default:
      return std::nullopt;
  }
}

/// Replaces red, green and blue by the brightness, in place. The weights are in units of 1/256.
void keep_brightness(std::span<std::byte> pixels) {
  constexpr int kRed = 77, kGreen = 150, kBlue = 29;
  const auto value = [&pixels](std::size_t at) { return std::to_integer<int>(pixels[at]); };
  for (std::size_t i = 0; 3 * i + 2 < pixels.size(); ++i)
    pixels[i] =
        static_cast<std::byte>((kRed * value(3 * i) + kGreen * value(3 * i + 1) + kBlue * value(3 * i + 2) + 128) >> 8);
}

}  // namespace

bool png_holds(PixelFormat pixels) { return libpng_format(pixels).has_value(); }

std::vector<std::byte> encode_png(const ImageView& image) {
  const std::optional<png_uint_32> pixels = libpng_format(image.format.pixels);
  if (!pixels) return {};
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.format.width_px);
  header.height = static_cast<png_uint_32>(image.format.height_px);
  header.format = *pixels;
  header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> png(size);
  const int written =
      png_image_write_to_memory(&header, png.data(), &size, 0, image.bytes.data(), image.format.stride_bytes, nullptr);
  png_image_free(&header);
  png.resize(written != 0 ? size : 0);
  return png;
}

std::optional<PngHeader> PngDecoder::read_header(std::span<const std::byte> png) {
  PngReader reader;
  return begin(reader, png, problem_);
}

ImageView PngDecoder::decode(std::span<const std::byte> png, PixelFormat pixels) {
  PngReader reader;
  const auto header = begin(reader, png, problem_);
  if (!header) return {};
  const bool brightness = becomes_brightness(*header, pixels);
  const PixelFormat read = brightness ? PixelFormat::rgb8 : pixels;
  const auto format = libpng_format(read);
  const std::size_t bytes = packed_format(read, header->width_px, header->height_px).bytes();
  if (format && pixels_.size() < bytes) pixels_.resize(bytes);
  if (!format || !reader.read_pixels(*format, std::span(pixels_).first(bytes))) {
    problem_ = format ? reader.message() : "cannot be decoded to the format asked for";
    return {};
  }
  if (brightness) keep_brightness(std::span(pixels_).first(bytes));
  const FrameFormat decoded = packed_format(pixels, header->width_px, header->height_px);
  return {decoded, std::span(pixels_).first(decoded.bytes())};
}

}  // namespace azimuth
