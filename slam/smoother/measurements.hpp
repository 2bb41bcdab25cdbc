#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "slam/smoother/odometry_measurement.hpp"
#include "slam/smoother/smoother_settings.hpp"

namespace azimuth {

// Numbers in the order of arrival. Only BearingGraph::forget() renumbers poses and bearings.
using PoseId = std::int32_t;
using BearingId = std::int32_t;
using LandmarkId = std::int32_t;
inline constexpr LandmarkId kOfNothing = -1;

/// Squared residual in standard deviations up to which a bearing counts as fitting. The robust kernel gives larger
/// residuals little weight.
inline constexpr double kFitsChi2 = 9.0;
/// Squared residual beyond which a bearing counts as a wrong association and is left out of noise estimates. Wrong
/// associations are spread over all directions, so few of them lie below this value; even heavy-tailed noise hardly
/// exceeds it.
inline constexpr double kScattersChi2 = 25.0;

/// Calibration values: the errors of odometry, then those of the camera (yaw, image centre, position on the robot).
inline constexpr int kCameraCalibrations = 5;
inline constexpr int kCalibrations = kOdometryCalibrations + kCameraCalibrations;
using Calibration = Eigen::Matrix<double, kCalibrations, 1>;
namespace calibration {
enum : std::uint8_t { scale_distance, scale_turn, drift, lag, lag_growth, yaw, centre_x, centre_y, camera_x, camera_y };
}  // namespace calibration

/// The prior standard deviation of each calibration value.
inline Calibration sigmas(const CalibrationPriors& priors) {
  Calibration sigma;
  sigma << priors.sigma_scale_distance, priors.sigma_scale_turn, priors.sigma_drift_rad_per_m, priors.sigma_lag_s,
      priors.sigma_lag_growth, priors.sigma_camera_yaw_rad, priors.sigma_centre_px, priors.sigma_centre_px,
      priors.sigma_camera_m, priors.sigma_camera_m;
  return sigma;
}

/// d(corrected azimuth) / d(image centre (x, y) [px]).
using ByCentre = Eigen::Vector2d;

inline constexpr std::int32_t kNoElevation = -1;

/// An azimuth measured from a pose.
struct BearingMeasurement {
  PoseId pose = 0;
  std::int32_t elevation = kNoElevation;  ///< index of its elevation; kNoElevation: none
  double azimuth_rad = 0.0, sigma_rad = 1.0;
  ByCentre by_centre = ByCentre::Zero();
};

/// An elevation measured together with an azimuth.
struct MeasuredElevation {
  double elevation_rad = 0.0;  ///< up from the horizontal
  double sigma_rad = 1.0;
};

/// The joint prior of landmarks and one pose from a saved map (mathematics VI.18). It is a Gaussian whose entries are
/// the pose's (x, y, heading), then (alpha, rho) of each landmark.
struct Remembered {
  PoseId pose = 0;  ///< 0 (the first pose): there is no pose, and it has no entries
  std::vector<LandmarkId> landmarks;
  Eigen::VectorXd mean;
  Eigen::MatrixXd information;  ///< inverse covariance
};

}  // namespace azimuth
