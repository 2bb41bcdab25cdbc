#include "tools/plot/canvas.hpp"

#include <algorithm>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string_view>

#include "base/sanitizers.hpp"

#ifdef AZIMUTH_ADDRESS_SANITIZER
// Suppresses a leak in fontconfig, which keeps font patterns until the process ends.
extern "C" {
const char* __lsan_default_suppressions();
const char* __lsan_default_options();
const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
const char* __lsan_default_options() { return "print_suppressions=0"; }
}
#endif

namespace azimuth {
namespace {

constexpr double kPdfPointsPerPixel = 0.45;  // 1600 pixels become 720 points, which fits A4 in landscape

cairo_status_t append(void* bytes, const unsigned char* more, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(more), size);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(PlotFormat format, int width_px, int height_px, std::string* bytes) {
  switch (format) {
    case PlotFormat::svg: {
      cairo_surface_t* const surface = cairo_svg_surface_create_for_stream(append, bytes, width_px, height_px);
      cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
      return surface;
    }
    case PlotFormat::pdf: {
      cairo_surface_t* const surface = cairo_pdf_surface_create_for_stream(append, bytes, kPdfPointsPerPixel * width_px,
                                                                           kPdfPointsPerPixel * height_px);
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");  // reproducible output
      return surface;
    }
    case PlotFormat::png:
      break;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px);
}

/// Removes the surface number from the SVG. Cairo counts surfaces per process, so that the output would not be
/// reproducible.
void forget_surface_number(std::string& svg) {
  constexpr std::string_view kBefore = "<g id=\"surface";
  const std::size_t at = svg.find(kBefore);
  if (at == std::string::npos) return;
  const std::size_t number = at + kBefore.size(), end = svg.find('"', number);
  if (end != std::string::npos) svg.erase(number, end - number);
}

/// Switches off hinting of metrics, so that text has the same width in all formats.
void forget_pixel_grid(cairo_t* context) {
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

}  // namespace

PlotCanvas::PlotCanvas(int width_px, int height_px, const Colour& background, PlotFormat format)
    : format_(format),
      bytes_(std::make_unique<std::string>()),
      surface_(make_surface(format, width_px, height_px, bytes_.get())),
      context_(cairo_create(surface_.get())) {
  if (format == PlotFormat::pdf) cairo_scale(context_.get(), kPdfPointsPerPixel, kPdfPointsPerPixel);
  forget_pixel_grid(context_.get());
  cairo_set_antialias(context_.get(), CAIRO_ANTIALIAS_BEST);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  set(background);
  cairo_paint(context_.get());
}

void PlotCanvas::set(const Colour& colour) {
  cairo_set_source_rgba(context_.get(), colour.red, colour.green, colour.blue, colour.alpha);
}

// Points that are not finite (for example, of a diverged estimate) interrupt the line.
void PlotCanvas::trace(std::span<const Eigen::Vector2d> points_px) {
  cairo_new_path(context_.get());
  for (const Eigen::Vector2d& point : points_px) {
    if (point.allFinite()) {
      cairo_line_to(context_.get(), point.x(), point.y());
    } else {
      cairo_new_sub_path(context_.get());
    }
  }
}

void PlotCanvas::image(const ImageView& image) {
  if (!image.readable() || format_ != PlotFormat::png || cairo_surface_status(surface_.get()) != CAIRO_STATUS_SUCCESS)
    return;
  const int samples = bytes_per_pixel(image.format.pixels);
  const int width = std::min(image.format.width_px, cairo_image_surface_get_width(surface_.get()));
  const int height = std::min(image.format.height_px, cairo_image_surface_get_height(surface_.get()));
  cairo_surface_flush(surface_.get());
  unsigned char* row = cairo_image_surface_get_data(surface_.get());
  for (int v = 0; v < height; ++v, row += cairo_image_surface_get_stride(surface_.get())) {
    const std::uint8_t* pixel = image.row(v);
    for (int u = 0; u < width; ++u, pixel += samples) {
      const std::uint32_t red = pixel[0], green = pixel[samples / 2], blue = pixel[samples - 1];
      const std::uint32_t word = (red << 16U) | (green << 8U) | blue;
      std::memcpy(row + 4 * u, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(surface_.get());
}

void PlotCanvas::line(std::span<const Eigen::Vector2d> points_px, const Colour& colour, double width_px) {
  trace(points_px);
  set(colour);
  cairo_set_line_width(context_.get(), width_px);
  cairo_stroke(context_.get());
}

void PlotCanvas::dashed_line(std::span<const Eigen::Vector2d> points_px, const Colour& colour, double width_px,
                             double dash_px) {
  cairo_set_dash(context_.get(), &dash_px, 1, 0.0);
  line(points_px, colour, width_px);
  cairo_set_dash(context_.get(), nullptr, 0, 0.0);
}

void PlotCanvas::add_outline(const Eigen::Vector2d& centre_px, double radius_px) {
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre_px.x(), centre_px.y(), radius_px, 0.0, 2.0 * std::numbers::pi);
}

void PlotCanvas::disc(const Eigen::Vector2d& centre_px, double radius_px, const Colour& colour) {
  add_outline(centre_px, radius_px);
  set(colour);
  cairo_fill(context_.get());
}

void PlotCanvas::ring(const Eigen::Vector2d& centre_px, double radius_px, const Colour& colour, double width_px) {
  add_outline(centre_px, radius_px);
  set(colour);
  cairo_set_line_width(context_.get(), width_px);
  cairo_stroke(context_.get());
}

void PlotCanvas::polygon(std::span<const Eigen::Vector2d> points_px, const Colour& fill, const Colour& edge,
                         double width_px) {
  trace(points_px);
  cairo_close_path(context_.get());
  set(fill);
  cairo_fill_preserve(context_.get());
  set(edge);
  cairo_set_line_width(context_.get(), width_px);
  cairo_stroke(context_.get());
}

void PlotCanvas::rectangle(const Eigen::Vector2d& low_px, const Eigen::Vector2d& size_px, const Colour& fill) {
  cairo_rectangle(context_.get(), low_px.x(), low_px.y(), size_px.x(), size_px.y());
  set(fill);
  cairo_fill(context_.get());
}

void PlotCanvas::select(const TextStyle& style) {
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size_px);
}

double PlotCanvas::text_width_px(const std::string& words, const TextStyle& style) {
  select(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), words.c_str(), &extents);
  return extents.x_advance;
}

void PlotCanvas::text(const std::string& words, const Eigen::Vector2d& at_px, const TextStyle& style, bool turned) {
  const double width_px = text_width_px(words, style);
  const double back_px = style.anchor == Anchor::left ? 0.0 : style.anchor == Anchor::centre ? width_px / 2 : width_px;
  cairo_save(context_.get());
  cairo_translate(context_.get(), at_px.x(), at_px.y());
  if (turned) cairo_rotate(context_.get(), -std::numbers::pi / 2);
  cairo_move_to(context_.get(), -back_px, 0.0);
  set(style.colour);
  cairo_show_text(context_.get(), words.c_str());
  cairo_restore(context_.get());
}

void PlotCanvas::clip(const Eigen::Vector2d& low_px, const Eigen::Vector2d& size_px) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), low_px.x(), low_px.y(), size_px.x(), size_px.y());
  cairo_clip(context_.get());
}

void PlotCanvas::release_clip() { cairo_restore(context_.get()); }

cairo_status_t PlotCanvas::encode() {
  if (const cairo_status_t status = cairo_status(context_.get()); status != CAIRO_STATUS_SUCCESS) return status;
  if (format_ == PlotFormat::png) return cairo_surface_write_to_png_stream(surface_.get(), append, bytes_.get());
  cairo_surface_finish(surface_.get());
  if (format_ == PlotFormat::svg) forget_surface_number(*bytes_);
  return cairo_surface_status(surface_.get());
}

tl::expected<std::string, std::string> PlotCanvas::file_bytes() {
  if (const cairo_status_t status = encode(); status != CAIRO_STATUS_SUCCESS)
    return tl::unexpected(std::string(cairo_status_to_string(status)));
  return *bytes_;
}

std::optional<std::string> PlotCanvas::write(const std::filesystem::path& file) {
  const tl::expected<std::string, std::string> bytes = file_bytes();
  if (!bytes) return bytes.error();
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream << *bytes;
  stream.close();
  if (!stream) return "cannot be written: " + std::string(std::strerror(errno));
  return std::nullopt;
}

}  // namespace azimuth
