#include "tools/lens_fit/residual_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

// These colours stay distinct for every kind of colour vision.
constexpr Colour kFits{0.337, 0.706, 0.914}, kDoesNot{0.835, 0.369, 0.0}, kLens{0.902, 0.624, 0.0};
constexpr Colour kBehind{0.0, 0.0, 0.0, 0.6};

Eigen::Vector2d on_canvas(const Pixel& pixel) { return pixel + Pixel(0.5, 0.5); }

void draw_lens(const Lens& lens, double unit, PlotCanvas& canvas) {
  const ImageAxes& axes = lens.axes;
  const Eigen::Vector2d centre = on_canvas({axes.centre_px.x(), axes.beta * axes.centre_px.y()});
  canvas.ring(centre, 4.0 * unit, kLens, 1.5 * unit);
  for (const double degrees : {30.0, 60.0, 90.0}) {
    const double radius = radius_px(lens, degrees * kPi / 180.0);
    if (std::isfinite(radius)) canvas.ring(centre, radius, kLens, unit);
  }
}

void draw_residuals(const std::vector<Residual>& residuals, double unit, PlotCanvas& canvas) {
  for (const Residual& each : residuals) {
    const Colour& colour = each.fits ? kFits : kDoesNot;
    const std::array<Eigen::Vector2d, 2> line{on_canvas(each.seen),
                                              on_canvas(each.seen + kResidualZoom * (each.seen - each.expected))};
    canvas.line(line, colour.with_alpha(0.8), 0.8 * unit);
    canvas.disc(line.front(), 1.2 * unit, colour);
  }
}

void write_words(const std::string& words, double unit, PlotCanvas& canvas) {
  const double size = 14.0 * unit;
  canvas.rectangle({0.0, 0.0}, {canvas.text_width_px(words, {size, kLens}) + size, 1.5 * size}, kBehind);
  canvas.text(words, {0.5 * size, 1.1 * size}, {size, kLens});
}

}  // namespace

PlotCanvas residual_picture(const ImageView& image, const Lens& lens, const std::vector<Residual>& residuals,
                            double rms_px) {
  PlotCanvas canvas(image.format.width_px, image.format.height_px, kBehind);
  canvas.image(image);
  const double unit = std::max(1.0, image.format.width_px / 700.0);
  draw_lens(lens, unit, canvas);
  draw_residuals(residuals, unit, canvas);
  const Pixel& centre = lens.axes.centre_px;
  write_words(fmt::format("centre ({:.1f}, {:.1f}) px, circles at 30, 60, 90 degrees, residuals {:.2f} px, drawn {:g} "
                          "times as long",
                          centre.x(), centre.y(), rms_px, kResidualZoom),
              unit, canvas);
  return canvas;
}

PlotCanvas lens_picture(const ImageView& image, const LensDrive& drive, const LensSolution& solution) {
  std::vector<Residual> residuals;
  for (std::size_t i = 0; i < drive.sightings.size(); ++i) {
    const LampObservation& sighting = drive.sightings[i];
    const Eigen::Vector3d& lamp = solution.lamps[sighting.lamp];
    Eigen::Vector3d point;
    point << inverse(solution.T_map_body[sighting.frame]) * Eigen::Vector2d(lamp.head<2>()),
        solution.lamp_height_m + lamp.z();
    const auto expected = solution.lens.image(point, solution.lens.axes.polar(sighting.pixel).radius_px);
    if (expected) residuals.push_back({sighting.pixel, expected->pixel, solution.fits[i]});
  }
  return residual_picture(image, solution.lens, residuals, solution.rms_px());
}

}  // namespace azimuth
