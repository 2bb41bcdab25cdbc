#pragma once
// How a camera's axis leans on the robot.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// Roll about x, forward, then pitch about y, to the left, both right-handed and about axes that stay (the "rpy" of
/// URDF, whose yaw comes last: here it is CameraRig::yaw_offset_rad, or the azimuths' offset):
///
///   v_level = R_y(pitch) R_x(roll) v_camera
///
/// Thread contract: reentrant.
struct CameraTilt {
  double roll_rad = 0.0;   ///< positive: the left side is lifted
  double pitch_rad = 0.0;  ///< positive: what is ahead is lowered

  bool is_level() const { return roll_rad == 0.0 && pitch_rad == 0.0; }
  Eigen::Matrix3d R_level_camera() const {
    return (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }
  /// d v_level / d(roll, pitch)
  Eigen::Matrix<double, 3, 2> by_tilt(const Eigen::Vector3d& v_level) const {
    const Eigen::Vector3d roll_axis(std::cos(pitch_rad), 0.0, -std::sin(pitch_rad));
    Eigen::Matrix<double, 3, 2> by_tilt;
    by_tilt << roll_axis.cross(v_level), Eigen::Vector3d::UnitY().cross(v_level);
    return by_tilt;
  }
};

/// The tilt by which the camera's axis points along `axis`, a unit vector in the robot's frame that is not level:
/// (sin(pitch) cos(roll), -sin(roll), cos(pitch) cos(roll)).
inline CameraTilt tilt_of_axis(const Eigen::Vector3d& axis) {
  return {.roll_rad = -std::asin(std::clamp(axis.y(), -1.0, 1.0)), .pitch_rad = std::atan2(axis.x(), axis.z())};
}

/// Of the azimuth of what is seen at `elevation_rad`, when roll and pitch are each off by `sigma_tilt_rad` (SPEC
/// VI.34). In the zenith nothing is known of it.
inline double azimuth_variance_by_tilt(double sigma_tilt_rad, double elevation_rad) {
  const double off_rad = sigma_tilt_rad * std::tan(elevation_rad);
  return std::min(off_rad * off_rad, kPi * kPi / 3.0);
}

}  // namespace azimuth
