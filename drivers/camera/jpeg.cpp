#include "drivers/camera/jpeg.hpp"

#include <new>
#include <turbojpeg.h>

namespace azimuth {

namespace {

// A warning means that something is missing or damaged: pixels made up from there on would become landmarks. Baseline
// files have a handful of scans; thousands of them are an attack on the reader's time.
constexpr int kDecodeFlags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT;

std::optional<int> turbo_format(PixelFormat pixels) {
  switch (pixels) {
    case PixelFormat::gray8:
      return TJPF_GRAY;
    case PixelFormat::rgb8:
      return TJPF_RGB;
    case PixelFormat::bgr8:
      return TJPF_BGR;
    default:
      return std::nullopt;
  }
}

const unsigned char* chars(std::span<const std::byte> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}
unsigned char* chars(std::span<std::byte> bytes) { return reinterpret_cast<unsigned char*>(bytes.data()); }

bool is_small_enough(int width_px, int height_px) {
  return is_valid(packed_format(PixelFormat::gray8, width_px, height_px)) && width_px <= kMaxJpegPixels / height_px;
}

/// A handle the library could not make is a lack of memory.
void* made(tjhandle handle) {
  if (handle == nullptr) throw std::bad_alloc();
  return handle;
}

}  // namespace

void JpegDecoder::Destroy::operator()(void* handle) const { tjDestroy(handle); }
void JpegEncoder::Destroy::operator()(void* handle) const { tjDestroy(handle); }

JpegDecoder::JpegDecoder() : handle_(made(tjInitDecompress())) {}

bool JpegDecoder::refuse(const char* why) {
  problem_ = why;
  return false;
}

/// A handle that met an error within a header takes the next image for the rest of it, so it is not used again.
bool JpegDecoder::refuse_damaged() {
  refuse(tjGetErrorStr2(handle_.get()));
  handle_.reset(made(tjInitDecompress()));
  return false;
}

bool JpegDecoder::read(std::span<const std::byte> jpeg, JpegHeader& header) {
  if (jpeg.empty()) return refuse("is empty");
  int width_px = 0, height_px = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(handle_.get(), chars(jpeg), jpeg.size(), &width_px, &height_px, &subsampling, &colours) != 0)
    return refuse_damaged();
  if (!is_small_enough(width_px, height_px)) return refuse("is too large");
  if (colours != TJCS_GRAY && colours != TJCS_RGB && colours != TJCS_YCbCr)
    return refuse("has colours that no camera has");
  header = {width_px, height_px, colours != TJCS_GRAY};
  problem_.clear();
  return true;
}

std::optional<JpegHeader> JpegDecoder::read_header(std::span<const std::byte> jpeg) {
  JpegHeader header;
  return read(jpeg, header) ? std::optional(header) : std::nullopt;
}

bool JpegDecoder::decode_into(std::span<const std::byte> jpeg, const FrameFormat& format, std::span<std::byte> pixels) {
  const std::optional<int> out = turbo_format(format.pixels);
  if (!out || !is_valid(format) || pixels.size() < format.bytes())
    return refuse("cannot be decoded to the format asked for");
  JpegHeader header;
  if (!read(jpeg, header)) return false;
  if (header.width_px != format.width_px || header.height_px != format.height_px) return refuse("is of another size");
  if (tjDecompress2(handle_.get(), chars(jpeg), jpeg.size(), chars(pixels), format.width_px, format.stride_bytes,
                    format.height_px, *out, kDecodeFlags) != 0)
    return refuse_damaged();
  return true;
}

ImageView JpegDecoder::decode(std::span<const std::byte> jpeg, PixelFormat pixels) {
  const std::optional<JpegHeader> header = read_header(jpeg);
  if (!header) return {};
  const FrameFormat format = packed_format(pixels, header->width_px, header->height_px);
  if (pixels_.size() < format.bytes()) pixels_.resize(format.bytes());
  if (!decode_into(jpeg, format, pixels_)) return {};
  return {format, std::span(pixels_).first(format.bytes())};
}

JpegEncoder::JpegEncoder() : handle_(made(tjInitCompress())) {}

std::span<const std::byte> JpegEncoder::encode(const ImageView& image, int quality) {
  const FrameFormat& format = image.format;
  const std::optional<int> in = turbo_format(format.pixels);
  if (!in || !image.readable() || quality < 1 || quality > 100) return {};
  if (!is_small_enough(format.width_px, format.height_px)) return {};
  const int subsampling = format.pixels == PixelFormat::gray8 ? TJSAMP_GRAY : TJSAMP_444;
  const std::size_t largest = tjBufSize(format.width_px, format.height_px, subsampling);
  if (file_.size() < largest) file_.resize(largest);
  unsigned char* out = chars(std::span(file_));
  unsigned long size = file_.size();
  if (tjCompress2(handle_.get(), chars(image.bytes), format.width_px, format.stride_bytes, format.height_px, *in, &out,
                  &size, subsampling, quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0)
    return {};
  return std::span(file_).first(size);
}

}  // namespace azimuth
