#pragma once
// The sensors of the simulated robot: its odometer, and its camera with a front end.
//
// The odometer has the forward motion model of mathematics I.3. It reports the motion of the wheels, and the robot
// performs this motion plus noise, so a filter with the true lambdas models the motion exactly. With zero lambdas the
// odometry is exact up to the calibration errors.

#include <vector>

#include "sim/world/random.hpp"
#include "sim/world/scene.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Names and meanings are those of rig.toml.
struct OdometerSettings {
  double lambda_distance_m = 2.5e-3;        ///< Variance of distance per metre [m^2/m]
  double lambda_rotation_rad = 1.2120e-3;   ///< Variance of each rotation per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< Variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< Sideways slip, standard deviation after one metre
  // The errors of an uncalibrated odometer: true = scale * raw, and the heading drifts by drift_rad_per_m.
  double scale_distance = 1.0;
  double scale_turn = 1.0;
  double drift_rad_per_m = 0.0;
  double lag_s = 0.0;  ///< The robot is at the pose reported for time t at time t + lag
};

/// The true motion of the robot when its wheels do `control`: the pose at the end in the frame of the start.
Pose2 disturbed(const Control& control, const OdometerSettings& settings, Random& random);

/// The odometer's reading of `control`, before calibration.
Control raw(const Control& control, const OdometerSettings& settings);

/// A camera with its front end, reduced to the bearings that they give.
struct BearingSensorSettings {
  double sigma_bearing_rad = 0.0261799387799;  ///< 1.5 deg
  double min_range_m = 0.2;                    ///< Landmarks nearer than this are hidden by the robot's mounting
  double max_range_m = 6.0;
  double field_of_view_rad = 6.283185307179586;          ///< Full angle, centred on the camera's zero azimuth
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< Position of the camera on the robot: forward, left
  double yaw_offset_rad = 0.0;                           ///< Angle from the heading to the camera's zero azimuth
  double detection_probability = 1.0;
  double clutter_per_set = 0.0;  ///< Mean number of false bearings, uniform over the field of view
  /// Bearings carry the landmark's identity; clutter carries the identity of a landmark that is not in the set.
  bool identities = true;
};

/// Makes one set of bearings as seen from `T_world_body`, ordered by azimuth so that the order reveals nothing. The
/// caller sets the stamp and the sequence number.
BearingSet observe(const std::vector<WorldLandmark>& landmarks, const Pose2& T_world_body,
                   const BearingSensorSettings& settings, Random& random);

}  // namespace azimuth
