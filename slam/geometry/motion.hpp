#pragma once
// The odometry motion model of SPEC I.3 (Schlegel & Hochdorfer eq 22 to 28, corrected), and its accumulation over
// many short segments.

#include <Eigen/Core>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Drive `distance_m` in the direction `first_turn_rad` off the heading, then turn by `second_turn_rad`.
/// Negative distance: driving backwards.
struct Control {
  double distance_m = 0.0;
  double first_turn_rad = 0.0;
  double second_turn_rad = 0.0;
};

/// Eq 22 to 26: the control between two poses of the same odometer. Below 0.1 mm the motion counts as a turn on the
/// spot. With `reverse_driving`, a direction more than 90 degrees off the heading is driven backwards instead of
/// charging two half turns.
Control control_between(const Pose2& T_odom_start, const Pose2& T_odom_end, bool reverse_driving = true);

/// Eq 27: the pose after `control`.
Pose2 move(const Pose2& T_map_body, const Control& control);

/// Noise of the motion; variances grow with what was driven (SPEC I.3).
struct MotionNoise {
  double lambda_distance_m = 0.0;           ///< variance of the distance per metre [m^2/m]
  double lambda_rotation_rad = 0.0;         ///< variance of each turn per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< sideways slip after one metre, standard deviation
};

using Matrix34d = Eigen::Matrix<double, 3, 4>;

/// Eq 28: G = d(pose')/d(pose) and V = d(pose')/d(distance, first turn, second turn, drift), both (x, y, heading).
struct MotionJacobians {
  Eigen::Matrix3d G;
  Matrix34d V;
};
MotionJacobians motion_jacobians(double heading_rad, const Control& control);

/// The diagonal of the control's covariance: (distance, first turn, second turn, drift).
Eigen::Vector4d control_variances(const Control& control, const MotionNoise& noise);

/// V diag(control_variances) V^T plus sideways slip: the noise one control adds, in the frame of `heading_rad`. V is
/// that of `control`, the variances are those of `charged`.
Eigen::Matrix3d motion_noise(double heading_rad, const Control& control, const Control& charged,
                             const MotionNoise& noise);
inline Eigen::Matrix3d motion_noise(double heading_rad, const Control& control, const MotionNoise& noise) {
  return motion_noise(heading_rad, control, control, noise);
}

/// What a scale of the odometer that is off does to a motion: d(x, y, heading) / d(relative error of every distance,
/// relative error of every turn).
using ByScales = Eigen::Matrix<double, 3, 2>;

/// What odometry says happened between two instants.
struct Motion {
  Pose2 T_start_end;                                     ///< pose at the end in the body frame of the start
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x, y, heading), body frame of the start
  double path_m = 0.0;                                   ///< length driven
  double turned_rad = 0.0;                               ///< sum of the turns' magnitudes
  ByScales by_scales = ByScales::Zero();                 ///< body frame of the start
  /// d(pose at the end, body frame of the start) / d(lag [s]), the instants being those of samples that were taken so
  /// much earlier than stamped: then the robot was not yet as far, at the end and at the start alike.
  Eigen::Vector3d by_lag = Eigen::Vector3d::Zero();
  /// d(pose at the end) / d(heading gained for each metre driven), body frame of the start.
  Eigen::Vector3d by_drift = Eigen::Vector3d::Zero();
  /// Of the body at the end, in its frame there: (m/s, m/s, rad/s). With a lag it has that much of a way still to go
  /// from where samples are of.
  Eigen::Vector3d velocity_at_end = Eigen::Vector3d::Zero();
  bool moved() const { return path_m > 0.0 || turned_rad > 0.0; }
};

/// Appends a control at the end of `motion`: the covariance of eq 15 carried over many segments, so that a drive
/// round a loop without a bearing is charged for its length and not for its chord. The variances are those of
/// `charged`, which is `control` unless its direction is known to be noise.
///
/// Errors of the odometer's scales are the same in every segment, so they are carried linearly: B <- G B + V [d; turn].
/// So are those of its drift.
void append(Motion& motion, const Control& control, const Control& charged, const MotionNoise& noise);

/// Appends a motion that begins where `motion` ends, with a noise of its own.
void append(Motion& motion, const Motion& more);

/// The pose and covariance after `motion`: P' = G P G^T + R Q R^T, with R the heading's rotation.
struct MovedPose {
  Pose2 T_map_body;
  Eigen::Matrix3d G;       ///< d(pose')/d(pose)
  Eigen::Matrix3d noise;   ///< R Q R^T
  ByScales by_scales;      ///< R B: d(pose')/d(relative errors of the scales)
  Eigen::Vector3d by_lag;  ///< R d(motion)/d(lag)
  Eigen::Vector3d by_drift;
};
MovedPose apply(const Pose2& T_map_body, const Motion& motion);

}  // namespace azimuth
