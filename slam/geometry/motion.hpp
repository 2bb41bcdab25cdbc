#pragma once
// The odometry motion model of mathematics I.3 (Schlegel & Hochdorfer eq 22 to 28, corrected), and its accumulation
// over many short segments.

#include <Eigen/Core>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A motion in three steps: turn by `first_turn_rad`, drive `distance_m`, turn by `second_turn_rad`. A negative
/// distance means driving backwards.
struct Control {
  double distance_m = 0.0;
  double first_turn_rad = 0.0;
  double second_turn_rad = 0.0;
};

/// The control between two poses of the same odometer (eq 22 to 26). Below 0.1 mm the motion counts as a turn on the
/// spot. With `reverse_driving`, a direction more than 90 degrees off the heading counts as driving backwards, which
/// avoids the noise of two half turns.
Control control_between(const Pose2& T_odom_start, const Pose2& T_odom_end, bool reverse_driving = true);

/// The pose after `control` (eq 27).
Pose2 move(const Pose2& T_map_body, const Control& control);

/// Noise of the motion; variances grow with the distance and the turns (mathematics I.3).
struct MotionNoise {
  double lambda_distance_m = 0.0;           ///< variance of the distance per metre [m^2/m]
  double lambda_rotation_rad = 0.0;         ///< variance of each turn per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< sideways slip after one metre, standard deviation
};

using Matrix34d = Eigen::Matrix<double, 3, 4>;

/// G = d(pose')/d(pose) and V = d(pose')/d(distance, first turn, second turn, drift), both for (x, y, heading) (eq 28).
struct MotionJacobians {
  Eigen::Matrix3d G;
  Matrix34d V;
};
MotionJacobians motion_jacobians(double heading_rad, const Control& control);

/// The diagonal of the control's covariance: (distance, first turn, second turn, drift).
Eigen::Vector4d control_variances(const Control& control, const MotionNoise& noise);

/// The noise that one control adds, in the frame of `heading_rad`: V diag(control_variances) V^T plus sideways slip. V
/// is that of `control`; the variances are those of `charged`.
Eigen::Matrix3d motion_noise(double heading_rad, const Control& control, const Control& charged,
                             const MotionNoise& noise);
inline Eigen::Matrix3d motion_noise(double heading_rad, const Control& control, const MotionNoise& noise) {
  return motion_noise(heading_rad, control, control, noise);
}

/// d(x, y, heading) / d(relative error of all distances, relative error of all turns): the effect of the odometer's
/// scale errors.
using ByScales = Eigen::Matrix<double, 3, 2>;

/// The motion between two instants, by odometry.
struct Motion {
  Pose2 T_start_end;                                     ///< pose at the end in the body frame of the start
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x, y, heading), body frame of the start
  double path_m = 0.0;                                   ///< length driven
  double turned_rad = 0.0;                               ///< sum of the turns' magnitudes
  ByScales by_scales = ByScales::Zero();                 ///< body frame of the start
  /// d(pose at the end, body frame of the start) / d(lag [s]). With a lag, the images at both instants were taken that
  /// much earlier than their stamps, so the robot had not yet come as far, at the start and at the end alike.
  Eigen::Vector3d by_lag = Eigen::Vector3d::Zero();
  /// d(pose at the end, body frame of the start) / d(heading gained per metre driven).
  Eigen::Vector3d by_drift = Eigen::Vector3d::Zero();
  /// Velocity at the end in the body frame there: (m/s, m/s, rad/s). With a lag, the robot is ahead of the image by the
  /// lag times this velocity.
  Eigen::Vector3d velocity_at_end = Eigen::Vector3d::Zero();
  bool moved() const { return path_m > 0.0 || turned_rad > 0.0; }
};

/// Appends a control at the end of `motion`. The covariance is that of eq 15 accumulated over all segments, so a loop
/// without bearings gets the noise of its length and not of its chord. The variances are those of `charged`, which
/// equals `control` unless the control's direction is known to be noise.
///
/// Scale errors are the same in every segment, so they accumulate linearly: B <- G B + V [d; turn]. Drift accumulates
/// in the same way.
void append(Motion& motion, const Control& control, const Control& charged, const MotionNoise& noise);

/// Appends a motion that begins where `motion` ends and has independent noise.
void append(Motion& motion, const Motion& more);

/// The pose after `motion` and the parts of its covariance: P' = G P G^T + R Q R^T, with R the rotation by the heading.
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
