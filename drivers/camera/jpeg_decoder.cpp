#include <jerror.h>
#include <new>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/libjpeg.hpp"

namespace azimuth {

namespace {

using libjpeg::Errors;

// Baseline files have a handful of scans. A file with thousands of scans is an attack on the decoder's time.
constexpr int kMostScans = 500;

// Largest number of superfluous bytes before a marker that counts as a camera's padding (Logitech cameras insert up to
// 9). Lost or damaged data rarely leave so few bytes.
constexpr int kMostPadding = 16;

}  // namespace

struct JpegDecoder::Library {
  Errors errors;
  jpeg_decompress_struct jpeg{};
  jpeg_progress_mgr progress{};
  bool is_in_pixels = false;  ///< past the headers
  bool has_ended = false;     ///< the data have ended without an end marker

  static Library& of(j_common_ptr common) { return *static_cast<Library*>(common->client_data); }

  Library() {
    jpeg.err = errors.prepare();
    errors.base.emit_message = [](j_common_ptr common, int level) {
      if (level < 0 && of(common).is_loss()) Errors::stop(common);
    };
    progress.progress_monitor = [](j_common_ptr common) {
      Library& library = of(common);
      if (library.jpeg.input_scan_number > kMostScans) {
        library.errors.base.msg_code = JERR_BAD_PROGRESSION;
        Errors::stop(common);
      }
    };
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { jpeg_destroy_decompress(&jpeg); }

  /// False: out of memory.
  bool create() {
    if (setjmp(errors.refused) != 0) return false;  // NOLINT(cert-err52-cpp): as libjpeg wants it
    jpeg_create_decompress(&jpeg);
    jpeg.client_data = this;
    jpeg.progress = &progress;
    return true;
  }

  /// True: the last warning of libjpeg means that pixels are missing and have been invented. Invented pixels could
  /// become landmarks.
  bool is_loss() {
    switch (errors.base.msg_code) {
      case JWRN_EXTRANEOUS_DATA:  // padding, garbage between headers, or remains of damaged data
        return is_in_pixels && (has_ended || errors.base.msg_parm.i[0] > kMostPadding);
      case JWRN_JPEG_EOF:  // after the last pixel, only the end marker is missing
        has_ended = true;
        return !is_in_pixels || has_further_scans();
      case JWRN_JFIF_MAJOR:
      case JWRN_ADOBE_XFORM:
      case JWRN_BOGUS_ICC:
      case JWRN_NOT_SEQUENTIAL:  // values without meaning in a baseline file
        return false;
      default:
        return true;
    }
  }
  bool has_further_scans() const { return jpeg.progressive_mode != 0 || jpeg.comps_in_scan != jpeg.num_components; }

  /// Reads up to the first pixel. False: there is none.
  bool begin(const unsigned char* bytes, std::size_t size) {
    if (setjmp(errors.refused) != 0) return false;  // NOLINT(cert-err52-cpp): as libjpeg wants it
    jpeg_abort_decompress(&jpeg);
    is_in_pixels = has_ended = false;
    jpeg_mem_src(&jpeg, bytes, static_cast<unsigned long>(size));
    jpeg_read_header(&jpeg, TRUE);
    return true;
  }

  /// Reads all rows, after begin(). False: some are missing.
  bool decode(J_COLOR_SPACE order, unsigned char* rows, std::size_t stride_bytes) {
    if (setjmp(errors.refused) != 0) return false;  // NOLINT(cert-err52-cpp): as libjpeg wants it
    is_in_pixels = true;
    jpeg.out_color_space = order;
    jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
      JSAMPROW row = rows + jpeg.output_scanline * stride_bytes;
      jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
  }
};

namespace {

const unsigned char* chars(std::span<const std::byte> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// Skips start markers that some cameras send before the one that libjpeg expects.
std::span<const std::byte> with_one_start(std::span<const std::byte> jpeg) {
  const auto is_start = [&jpeg](std::size_t at) {
    return jpeg[at] == std::byte{0xFF} && jpeg[at + 1] == std::byte{0xD8};
  };
  while (jpeg.size() >= 4 && is_start(0) && is_start(2)) jpeg = jpeg.subspan(2);
  return jpeg;
}

}  // namespace

void JpegDecoder::Destroy::operator()(Library* library) const { delete library; }

JpegDecoder::JpegDecoder() : library_(new Library) {
  if (!library_->create()) throw std::bad_alloc();
}

bool JpegDecoder::refuse(const char* why) {
  problem_ = why;
  return false;
}

/// After an error inside a header, libjpeg could take the next image for the rest of that header. So the library object
/// is replaced.
bool JpegDecoder::refuse_damaged() {
  refuse(library_->errors.message.data());
  library_.reset(new Library);
  if (!library_->create()) throw std::bad_alloc();
  return false;
}

bool JpegDecoder::read(std::span<const std::byte> jpeg, JpegHeader& header) {
  if (jpeg.empty()) return refuse("is empty");
  const std::span<const std::byte> image = with_one_start(jpeg);
  if (!library_->begin(chars(image), image.size())) return refuse_damaged();
  const jpeg_decompress_struct& said = library_->jpeg;
  const auto width_px = static_cast<int>(said.image_width), height_px = static_cast<int>(said.image_height);
  if (!libjpeg::is_small_enough(width_px, height_px)) return refuse("is too large");
  const J_COLOR_SPACE colours = said.jpeg_color_space;
  if (colours != JCS_GRAYSCALE && colours != JCS_RGB && colours != JCS_YCbCr)
    return refuse("has colours that no camera has");
  header = {width_px, height_px, colours != JCS_GRAYSCALE};
  problem_.clear();
  return true;
}

std::optional<JpegHeader> JpegDecoder::read_header(std::span<const std::byte> jpeg) {
  JpegHeader header;
  return read(jpeg, header) ? std::optional(header) : std::nullopt;
}

bool JpegDecoder::decode_into(std::span<const std::byte> jpeg, const FrameFormat& format, std::span<std::byte> pixels) {
  const std::optional<J_COLOR_SPACE> order = libjpeg::order_of(format.pixels);
  if (!order || !is_valid(format) || pixels.size() < format.bytes())
    return refuse("cannot be decoded to the format asked for");
  JpegHeader header;
  if (!read(jpeg, header)) return false;
  if (header.width_px != format.width_px || header.height_px != format.height_px) return refuse("is of another size");
  auto* const rows = reinterpret_cast<unsigned char*>(pixels.data());
  return library_->decode(*order, rows, static_cast<std::size_t>(format.stride_bytes)) || refuse_damaged();
}

ImageView JpegDecoder::decode(std::span<const std::byte> jpeg, PixelFormat pixels) {
  const std::optional<JpegHeader> header = read_header(jpeg);
  if (!header) return {};
  const FrameFormat format = packed_format(pixels, header->width_px, header->height_px);
  if (pixels_.size() < format.bytes()) pixels_.resize(format.bytes());
  if (!decode_into(jpeg, format, pixels_)) return {};
  return {format, std::span(pixels_).first(format.bytes())};
}

}  // namespace azimuth
