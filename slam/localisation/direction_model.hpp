#pragma once
// A direction as a ray from the camera, and the position of a landmark in the ray's tangent plane. Unlike azimuth and
// elevation, this has no singularity at the zenith.

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "slam/geometry/pose2.hpp"
#include "slam/localisation/known_map.hpp"

namespace azimuth {

/// A measured direction as an orthonormal frame, in the robot's frame. Without an elevation it is horizontal and `up`
/// is not used.
struct SeenRay {
  Eigen::Vector3d along, across, up;
  double variance_across = 0.0, variance_up = 0.0;  ///< [rad^2]
  bool spatial = false;                             ///< The direction has an elevation
  SeenDirection seen;
};

/// Nothing for a direction that is not finite or has no positive sigma.
std::optional<SeenRay> make_ray(const SeenDirection& seen);

/// The horizontal part of a ray, for landmarks of unknown height.
SeenRay flattened(const SeenRay& ray);

/// A camera at some pose in the map.
struct CameraPlace {
  double x_m, y_m, cos, sin, height_m;
  CameraPlace(const Pose2& T_map_body, double camera_height_m)
      : x_m(T_map_body.x_m),
        y_m(T_map_body.y_m),
        cos(std::cos(T_map_body.heading_rad)),
        sin(std::sin(T_map_body.heading_rad)),
        height_m(camera_height_m) {}

  /// Position of a landmark relative to the camera, in the robot's frame; z is 0 where its height is not known.
  Eigen::Vector3d operator()(const KnownLandmark& landmark) const {
    const double dx = landmark.p_map_m.x() - x_m, dy = landmark.p_map_m.y() - y_m;
    return {cos * dx + sin * dy, cos * dy - sin * dx, landmark.has_height() ? landmark.p_map_m.z() - height_m : 0.0};
  }
};

/// The predicted position of a landmark relative to the measured direction.
struct Appearance {
  int rows = 1;                                          ///< 1: across only
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();  ///< Measured minus predicted, (across, up) [rad]
  Eigen::Matrix<double, 2, 3> by_pose;                   ///< d(predicted) / d(x, y, heading)
  Eigen::Matrix2d noise = Eigen::Matrix2d::Identity();   ///< Noise of the direction and of the landmark's position
};

/* With v = R(heading)^T (q - p), the landmark relative to the camera, and s = along . v:
 *   expected = (across . v / s, up . v / s)
 *   d(expected)/dv = (across - expected_1 along, up - expected_2 along) / s
 *   dv/d(x, y) = -R^T, dv/d(heading) = (v_y, -v_x, 0), dv/dq = R^T
 * Nothing for a landmark behind the camera or nearer than a few centimetres. */
std::optional<Appearance> appearance(const Pose2& T_map_body, const SeenRay& ray, const KnownLandmark& landmark,
                                     double camera_height_m);

}  // namespace azimuth
