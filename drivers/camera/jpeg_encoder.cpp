#include <jerror.h>
#include <new>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/libjpeg.hpp"

namespace azimuth {

using libjpeg::Errors;

struct JpegEncoder::Library {
  Errors errors;
  jpeg_compress_struct jpeg{};
  jpeg_destination_mgr out{};
  std::span<std::byte> file;

  Library() { jpeg.err = errors.prepare(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { jpeg_destroy_compress(&jpeg); }

  /// False: out of memory.
  bool create() {
    if (setjmp(errors.refused) != 0) return false;  // NOLINT(cert-err52-cpp): as libjpeg wants it
    jpeg_create_compress(&jpeg);
    jpeg.client_data = this;
    jpeg.dest = &out;
    out.init_destination = [](j_compress_ptr compress) {
      const std::span<std::byte> into = static_cast<Library*>(compress->client_data)->file;
      compress->dest->next_output_byte = reinterpret_cast<JOCTET*>(into.data());
      compress->dest->free_in_buffer = into.size();
    };
    out.empty_output_buffer = [](j_compress_ptr compress) -> boolean {
      compress->err->msg_code = JERR_BUFFER_SIZE;
      Errors::stop(reinterpret_cast<j_common_ptr>(compress));
    };
    out.term_destination = [](j_compress_ptr) {};
    return true;
  }

  void describe(const FrameFormat& format, J_COLOR_SPACE order, int quality) {
    jpeg.image_width = static_cast<JDIMENSION>(format.width_px);
    jpeg.image_height = static_cast<JDIMENSION>(format.height_px);
    jpeg.input_components = bytes_per_pixel(format.pixels);
    jpeg.in_color_space = order;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg.dct_method = JDCT_ISLOW;
    jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 1;  // colours at full resolution
  }

  /// Returns the size of the file; 0: the buffer is too small.
  std::size_t encode(const ImageView& image, J_COLOR_SPACE order, int quality) {
    if (setjmp(errors.refused) != 0) return 0;  // NOLINT(cert-err52-cpp): as libjpeg wants it
    jpeg_abort_compress(&jpeg);
    describe(image.format, order, quality);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
      JSAMPROW row = const_cast<JSAMPROW>(image.row(static_cast<int>(jpeg.next_scanline)));  // libjpeg only reads it
      jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    return file.size() - out.free_in_buffer;
  }
};

namespace {

/// Upper bound for the size of a file with this format, headers included.
std::size_t largest_file(const FrameFormat& format) {
  const auto blocks = [](int side_px) { return (static_cast<std::size_t>(side_px) + 7) & ~std::size_t{7}; };
  const std::size_t samples = format.pixels == PixelFormat::gray8 ? 2 : 6;  // twice the number of samples
  return blocks(format.width_px) * blocks(format.height_px) * samples + 2048;
}

}  // namespace

void JpegEncoder::Destroy::operator()(Library* library) const { delete library; }

JpegEncoder::JpegEncoder() : library_(new Library) {
  if (!library_->create()) throw std::bad_alloc();
}

std::span<const std::byte> JpegEncoder::encode(const ImageView& image, int quality) {
  const FrameFormat& format = image.format;
  const std::optional<J_COLOR_SPACE> order = libjpeg::order_of(format.pixels);
  if (!order || !image.readable() || quality < 1 || quality > 100) return {};
  if (!libjpeg::is_small_enough(format.width_px, format.height_px)) return {};
  if (const std::size_t largest = largest_file(format); file_.size() < largest) file_.resize(largest);
  library_->file = file_;
  return std::span(file_).first(library_->encode(image, *order, quality));
}

}  // namespace azimuth
