#pragma once
// Compares detected lamps with their true directions.

#include <cmath>
#include <optional>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth::test {

/// The direction from the camera to a point in the world, computed from geometry only.
inline Direction direction_to(const Pose2& T_world_camera, double height_m, const Eigen::Vector3d& p_world) {
  const Eigen::Vector2d flat = inverse(T_world_camera) * Eigen::Vector2d(p_world.head<2>());
  return direction(Eigen::Vector3d(flat.x(), flat.y(), p_world.z() - height_m));
}

inline double angle_between(const Direction& a, const Bearing& b) {
  return std::acos(std::min(1.0, ray(a).dot(ray(Direction{b.azimuth_rad, b.elevation_rad}))));
}

/// Errors of a detection divided by its stated standard deviations.
struct Normalised {
  double azimuth = 0.0, elevation = 0.0;
};
inline Normalised normalised(const Direction& truth, const Bearing& seen) {
  return {wrap(seen.azimuth_rad - truth.azimuth_rad) / seen.sigma_rad,
          (seen.elevation_rad - truth.elevation_rad) / seen.sigma_elevation_rad};
}

/// Index of the bearing nearest to `to` within `radius_rad`; no value if there is none.
inline std::optional<std::size_t> nearest(const std::vector<Bearing>& bearings, const Direction& to,
                                          double radius_rad) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    const double away_rad = angle_between(to, bearings[k]);
    if (away_rad >= radius_rad) continue;
    radius_rad = away_rad;
    best = k;
  }
  return best;
}

/// Sums of squared normalised errors, and counts of missed and false detections.
struct LampScore {
  int expected = 0, found = 0, made_up = 0, images = 0;
  double azimuth2 = 0.0, elevation2 = 0.0, worst = 0.0;

  void add(const std::vector<Direction>& lamps, const std::vector<Bearing>& seen) {
    ++images;
    made_up += static_cast<int>(seen.size());
    for (const Direction& lamp : lamps) {
      ++expected;
      const auto match = nearest(seen, lamp, 0.02);
      if (!match) continue;
      ++found;
      --made_up;
      const Normalised error = normalised(lamp, seen[*match]);
      azimuth2 += error.azimuth * error.azimuth;
      elevation2 += error.elevation * error.elevation;
      worst = std::max({worst, std::abs(error.azimuth), std::abs(error.elevation)});
    }
  }
  double azimuth_rms() const { return std::sqrt(azimuth2 / found); }
  double elevation_rms() const { return std::sqrt(elevation2 / found); }
};

}  // namespace azimuth::test
