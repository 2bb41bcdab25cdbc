#pragma once
// The tilt of a camera's axis on the robot.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// A roll about x (forward) followed by a pitch about y (left). Both are right-handed and about fixed axes. This is the
/// "rpy" of URDF; the yaw of "rpy", applied last, is CameraRig::yaw_offset_rad or the offset of the azimuths:
///
///   v_level = R_y(pitch) R_x(roll) v_camera
///
/// Thread contract: reentrant.
struct CameraTilt {
  double roll_rad = 0.0;   ///< Positive: the left side is lifted.
  double pitch_rad = 0.0;  ///< Positive: the front is lowered.

  bool is_level() const { return roll_rad == 0.0 && pitch_rad == 0.0; }
  Eigen::Matrix3d R_level_camera() const {
    return (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }
  /// d v_level / d (roll, pitch).
  Eigen::Matrix<double, 3, 2> by_tilt(const Eigen::Vector3d& v_level) const {
    const Eigen::Vector3d roll_axis(std::cos(pitch_rad), 0.0, -std::sin(pitch_rad));
    Eigen::Matrix<double, 3, 2> by_tilt;
    by_tilt << roll_axis.cross(v_level), Eigen::Vector3d::UnitY().cross(v_level);
    return by_tilt;
  }
};

/// The tilt for which the camera's axis points along `axis`, a unit vector in the robot's frame that is not horizontal:
/// axis = (sin(pitch) cos(roll), -sin(roll), cos(pitch) cos(roll)).
inline CameraTilt tilt_of_axis(const Eigen::Vector3d& axis) {
  return {.roll_rad = -std::asin(std::clamp(axis.y(), -1.0, 1.0)), .pitch_rad = std::atan2(axis.x(), axis.z())};
}

/// Variance of the azimuth of an object at `elevation_rad` if roll and pitch each have the standard deviation
/// `sigma_tilt_rad` (mathematics VI.34). It is bounded by the variance of an unknown azimuth, which it reaches near the
/// zenith.
inline double azimuth_variance_by_tilt(double sigma_tilt_rad, double elevation_rad) {
  const double off_rad = sigma_tilt_rad * std::tan(elevation_rad);
  return std::min(off_rad * off_rad, kPi * kPi / 3.0);
}

}  // namespace azimuth
