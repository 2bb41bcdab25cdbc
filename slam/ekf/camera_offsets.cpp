#include "slam/ekf/camera_offsets.hpp"

#include <algorithm>

namespace azimuth {
namespace {

/// l(r) and dl/dr; zero beyond the edge of the image.
struct Lean {
  double length_px = 0.0, slope = 0.0;
};

Lean lean(const RadialProfile& profile, double radius_px) {
  const auto at = std::visit([&](const auto& shape) { return shape.elevation_at(radius_px); }, profile);
  if (!at) return {};
  const double tangent = std::tan(at->elevation_rad);
  return {radius_px * tangent, tangent + radius_px * (1.0 + tangent * tangent) * at->slope_rad_per_px};
}

}  // namespace

/* dp/de = -(I + l' (pitch, -roll) p0^T / |p0|),   dp/d(roll) = l (0, -1),   dp/d(pitch) = l (1, 0) */
CentredPixel centred(double azimuth_rad, double radius_px, const Eigen::Vector4d& errors,
                     const std::optional<RadialProfile>& profile) {
  CentredPixel seen{radius_px * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad)) - errors.head<2>(),
                    Eigen::Matrix<double, 2, 4>::Zero()};
  seen.by_camera.leftCols<2>() = -Eigen::Matrix2d::Identity();
  if (!profile) return seen;
  const double from_centre_px = std::max(seen.p_px.norm(), CameraOffsets::kNearCentre_px);
  const auto [length_px, slope] = lean(*profile, from_centre_px);
  const Eigen::Vector2d way(errors(3), -errors(2));
  seen.by_camera.leftCols<2>() -= slope / from_centre_px * way * seen.p_px.transpose();
  seen.by_camera.rightCols<2>() << 0.0, length_px, -length_px, 0.0;
  seen.p_px += length_px * way;
  return seen;
}

}  // namespace azimuth
