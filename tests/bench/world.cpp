#include "tests/bench/world.hpp"

#include <cmath>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/halton.hpp"

namespace azimuth::bench {

std::vector<Eigen::Vector2d> make_landmarks(int count) {
  std::vector<Eigen::Vector2d> landmarks;
  for (int i = 1; i <= count; ++i) {
    const bool seen = i <= kSeen;
    const double range_m = seen ? 3.0 : 3.0 * kSightRange_m + 30.0 * van_der_corput(i, 2);
    // Landmarks keep away from the x axis, the robot's path, where two bearings would intersect at a very small angle.
    const double side = i % 2 == 0 ? 0.0 : kPi;
    const double angle_rad = side + degrees_to_rad(20.0 + 140.0 * van_der_corput(i, 3));
    landmarks.emplace_back(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
  }
  return landmarks;
}

double azimuth_to(const Pose2& T_map_body, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d p_body = inverse(T_map_body) * p_map;
  return std::atan2(p_body.y(), p_body.x());
}

Motion straight(double distance_m) {
  Motion motion;
  motion.T_start_end = {distance_m, 0.0, 0.0};
  motion.covariance = Eigen::Vector3d(1e-5, 1e-6, 1e-6).asDiagonal();
  motion.path_m = std::abs(distance_m);
  return motion;
}

}  // namespace azimuth::bench
