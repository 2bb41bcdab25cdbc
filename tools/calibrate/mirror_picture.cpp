#include "tools/calibrate/mirror_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <vector>

namespace azimuth {
namespace {

// These colours stay distinct for every kind of colour vision. The dark edge separates them from any image.
constexpr Colour kRim{0.902, 0.624, 0.0};
constexpr Colour kDisc{0.337, 0.706, 0.914};
constexpr Colour kEdge{0.0, 0.0, 0.0, 0.6};

/// Pixel coordinates are whole at pixel centres; canvas coordinates are whole at pixel corners.
Eigen::Vector2d on_canvas(const Pixel& pixel) { return pixel + Pixel(0.5, 0.5); }

class MirrorPicture {
 public:
  explicit MirrorPicture(const ImageView& image)
      : canvas_(image.format.width_px, image.format.height_px, kEdge),
        unit_(std::max(1.0, image.format.width_px / 700.0)) {
    canvas_.image(image);
  }

  void circle(const Circle& circle, const Colour& colour) {
    constexpr int kCorners = 720;
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= kCorners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kCorners;
      points.push_back(on_canvas(circle.centre_px + circle.radius_px * Pixel(std::cos(angle), std::sin(angle))));
    }
    stroke(points, colour);
  }
  void cross(const Pixel& at, const Colour& colour) {
    const double arm = 9.0 * unit_;
    stroke({on_canvas(at - Pixel(arm, 0.0)), on_canvas(at + Pixel(arm, 0.0))}, colour);
    stroke({on_canvas(at - Pixel(0.0, arm)), on_canvas(at + Pixel(0.0, arm))}, colour);
  }
  void label(const std::string& words, int line, const Colour& colour) {
    const double size = 14.0 * unit_;
    canvas_.rectangle({0.0, 1.5 * size * line}, {canvas_.text_width_px(words, {size, colour}) + size, 1.5 * size},
                      kEdge);
    canvas_.text(words, {0.5 * size, (1.5 * line + 1.1) * size}, {size, colour});
  }
  PlotCanvas done() && { return std::move(canvas_); }

 private:
  void stroke(const std::vector<Eigen::Vector2d>& points, const Colour& colour) {
    canvas_.line(points, kEdge, 3.5 * unit_);
    canvas_.line(points, colour, 1.5 * unit_);
  }

  PlotCanvas canvas_;
  double unit_;
};

std::string words(const char* name, const Circle& circle) {
  return fmt::format("{} ({:.1f}, {:.1f}) radius {:.1f} px", name, circle.centre_px.x(), circle.centre_px.y(),
                     circle.radius_px);
}

}  // namespace

PlotCanvas mirror_picture(const ImageView& image, const MirrorCircle& mirror) {
  MirrorPicture picture(image);
  picture.circle(mirror.rim, kRim);
  picture.cross(mirror.rim.centre_px, kRim);
  picture.label(words("mirror", mirror.rim), 0, kRim);
  if (mirror.inner) {
    picture.circle(*mirror.inner, kDisc);
    picture.label(words("inner disc", *mirror.inner), 1, kDisc);
  }
  return std::move(picture).done();
}

}  // namespace azimuth
