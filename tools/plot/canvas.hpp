#pragma once
#include <Eigen/Core>
#include <cairo.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "slam/sample/image.hpp"
#include "tools/plot/plot_format.hpp"

namespace azimuth {

struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0, alpha = 1.0;
  Colour with_alpha(double opacity) const { return {red, green, blue, opacity}; }
};

enum class Anchor { left, centre, right };

struct TextStyle {
  double size_px = 20.0;
  Colour colour;
  bool bold = false;
  Anchor anchor = Anchor::left;
};

/// A picture with the drawing operations that maps need. Coordinates are pixels from the top left corner. Errors
/// persist and are returned by write().
///
/// Thread contract: thread-bound.
class PlotCanvas {
 public:
  PlotCanvas(int width_px, int height_px, const Colour& background, PlotFormat format = PlotFormat::png);

  void line(std::span<const Eigen::Vector2d> points_px, const Colour& colour, double width_px);
  void dashed_line(std::span<const Eigen::Vector2d> points_px, const Colour& colour, double width_px, double dash_px);
  void disc(const Eigen::Vector2d& centre_px, double radius_px, const Colour& colour);
  void ring(const Eigen::Vector2d& centre_px, double radius_px, const Colour& colour, double width_px);
  void polygon(std::span<const Eigen::Vector2d> points_px, const Colour& fill, const Colour& edge, double width_px);
  void rectangle(const Eigen::Vector2d& low_px, const Eigen::Vector2d& size_px, const Colour& fill);
  /// Draws a gray8 or rgb8 image without scaling at the top left corner. Parts beyond the canvas are cut off. Only for
  /// the format PNG.
  void image(const ImageView& image);
  /// `at_px` is on the text's baseline. Text that is `turned` reads upwards.
  void text(const std::string& words, const Eigen::Vector2d& at_px, const TextStyle& style, bool turned = false);
  double text_width_px(const std::string& words, const TextStyle& style);

  /// Clips all further drawing to the rectangle until release_clip().
  void clip(const Eigen::Vector2d& low_px, const Eigen::Vector2d& size_px);
  void release_clip();

  /// Ends the drawing and returns the bytes of the file, or the reason if it fails. The same drawing operations give
  /// the same bytes.
  tl::expected<std::string, std::string> file_bytes();
  /// Writes file_bytes() to the file. Returns the reason if it fails.
  [[nodiscard]] std::optional<std::string> write(const std::filesystem::path& file);

 private:
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  void add_outline(const Eigen::Vector2d& centre_px, double radius_px);
  cairo_status_t encode();
  void set(const Colour& colour);
  void trace(std::span<const Eigen::Vector2d> points_px);
  void select(const TextStyle& style);

  PlotFormat format_;
  std::unique_ptr<std::string> bytes_;  // must outlive surface_: SVG and PDF surfaces write to it
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

}  // namespace azimuth
