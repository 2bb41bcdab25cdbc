#include "slam/camera/direction_table.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

// Step between directions, along the radius and around it. mathematics II.2 asks for less than 0.5, which misses no
// pixel but makes the interval of a pixel only half as wide as the pixel.
constexpr double kStep_px = 0.2;
constexpr double kSearchStep_rad = 1e-3;  // Step where the camera does not see

/// The elevation below `elevation_rad` whose image is one step further along the radius.
double next_below(const CameraModel& camera, const Pixel& pixel, double elevation_rad) {
  const Eigen::Matrix2d jacobian = camera.direction_jacobian(pixel).value_or(Eigen::Matrix2d::Zero());
  const double slope_rad_per_px = jacobian.row(1).norm();
  return elevation_rad - std::clamp(kStep_px * slope_rad_per_px, 1e-6, kSearchStep_rad * 10.0);
}

}  // namespace

DirectionTable::DirectionTable(const CameraModel& camera, int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px), extents_(as_size(width_px) * as_size(height_px)) {
  const CameraModel upright = camera.upright();
  const ImageAxes& axes = camera.axes();
  const double reach_px = hypotenuse(std::max(axes.centre_px.x(), width_px - axes.centre_px.x()),
                                     std::max(axes.centre_px.y(), height_px / axes.beta - axes.centre_px.y()));
  for (double elevation_rad = kPi / 2.0; elevation_rad >= -kPi / 2.0;) {
    const auto pixel = upright.pixel(Direction{axes.azimuth_offset_rad, elevation_rad});
    const double radius_px = pixel ? axes.polar(*pixel).radius_px : 0.0;
    if (!pixel || radius_px > reach_px) {
      elevation_rad -= kSearchStep_rad;
      continue;
    }
    // Non-square pixels need as small a step along their shorter side.
    const double step_px = kStep_px * std::min(1.0, 1.0 / axes.beta);
    const int around = 8 + static_cast<int>(2.0 * kPi * radius_px / step_px);
    for (int k = 0; k < around; ++k) {
      const double azimuth_rad = wrap(2.0 * kPi * k / around);
      widen(axes.pixel({radius_px, azimuth_rad}), camera.levelled({azimuth_rad, elevation_rad}));
    }
    elevation_rad = next_below(upright, *pixel, elevation_rad);
  }
}

void DirectionTable::widen(const Pixel& pixel, const Direction& direction) {
  const auto where = index(pixel);
  if (!where) return;
  Extent& extent = extents_[*where];
  const auto elevation_rad = static_cast<float>(direction.elevation_rad);
  if (extent.greatest_rad < extent.least_rad) {
    extent = {static_cast<float>(direction.azimuth_rad), 0.0F, 0.0F, elevation_rad, elevation_rad};
    return;
  }
  const auto offset_rad = static_cast<float>(wrap(direction.azimuth_rad - static_cast<double>(extent.azimuth_rad)));
  extent.least_rad = std::min(extent.least_rad, offset_rad);
  extent.greatest_rad = std::max(extent.greatest_rad, offset_rad);
  extent.low_rad = std::min(extent.low_rad, elevation_rad);
  extent.high_rad = std::max(extent.high_rad, elevation_rad);
}

std::optional<std::size_t> DirectionTable::index(const Pixel& pixel) const {
  const double u = std::round(pixel.x()), v = std::round(pixel.y());
  if (!(u >= 0.0 && u < width_px_ && v >= 0.0 && v < height_px_)) return std::nullopt;
  return static_cast<std::size_t>(v) * as_size(width_px_) + static_cast<std::size_t>(u);
}

std::optional<DirectionCell> DirectionTable::at(const Pixel& pixel) const {
  const auto where = index(pixel);
  if (!where || extents_[*where].greatest_rad < extents_[*where].least_rad) return std::nullopt;
  const Extent& extent = extents_[*where];
  const auto half = [](float low, float high) { return 0.5 * (static_cast<double>(high) - static_cast<double>(low)); };
  const Eigen::Vector2d half_rad{half(extent.least_rad, extent.greatest_rad), half(extent.low_rad, extent.high_rad)};
  const double azimuth_rad =
      wrap(static_cast<double>(extent.azimuth_rad) + static_cast<double>(extent.least_rad) + half_rad.x());
  return DirectionCell{{azimuth_rad, static_cast<double>(extent.low_rad) + half_rad.y()}, half_rad};
}

}  // namespace azimuth
