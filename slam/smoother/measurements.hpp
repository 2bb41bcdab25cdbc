#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "slam/smoother/odometry_measurement.hpp"
#include "slam/smoother/smoother_settings.hpp"

namespace azimuth {

// Numbers given in the order of arrival. Until the graph forgets some they are never those of something else.
using PoseId = std::int32_t;
using BearingId = std::int32_t;
using LandmarkId = std::int32_t;
inline constexpr LandmarkId kOfNothing = -1;

/// What fits worse, squared in standard deviations, the robust kernel hardly listens to.
inline constexpr double kFitsChi2 = 9.0;
/// One beyond this is not of what it is said to be, and no measure of noise: wrong names are of anywhere, so few of
/// them are nearer; noise whose tails are longer than a Gaussian's hardly goes beyond.
inline constexpr double kScattersChi2 = 25.0;

/// Errors of odometry, then those of the camera: its yaw, where the image's centre is, and where the camera stands on
/// the robot.
inline constexpr int kCameraCalibrations = 5;
inline constexpr int kCalibrations = kOdometryCalibrations + kCameraCalibrations;
using Calibration = Eigen::Matrix<double, kCalibrations, 1>;
namespace calibration {
enum : std::uint8_t { scale_distance, scale_turn, drift, lag, lag_growth, yaw, centre_x, centre_y, camera_x, camera_y };
}  // namespace calibration

/// Of each, what is known before.
inline Calibration sigmas(const CalibrationPriors& priors) {
  Calibration sigma;
  sigma << priors.sigma_scale_distance, priors.sigma_scale_turn, priors.sigma_drift_rad_per_m, priors.sigma_lag_s,
      priors.sigma_lag_growth, priors.sigma_camera_yaw_rad, priors.sigma_centre_px, priors.sigma_centre_px,
      priors.sigma_camera_m, priors.sigma_camera_m;
  return sigma;
}

/// What an image's centre that is elsewhere does to an azimuth: by its x and y, in pixels.
using ByCentre = Eigen::Vector2d;

inline constexpr std::int32_t kNoElevation = -1;

/// A direction from a pose.
struct BearingMeasurement {
  PoseId pose = 0;
  std::int32_t elevation = kNoElevation;  ///< which of those it has
  double azimuth_rad = 0.0, sigma_rad = 1.0;
  ByCentre by_centre = ByCentre::Zero();
};

/// How high a direction points, if it was measured.
struct MeasuredElevation {
  double elevation_rad = 0.0;  ///< up from the horizontal
  double sigma_rad = 1.0;
};

/// What is known of landmarks and a pose from before, all together (SPEC VI.18): a Gaussian of, one after another, the
/// pose's (x, y, heading) and each landmark's (alpha, rho).
struct Remembered {
  PoseId pose = 0;  ///< 0, the first one: none; it has no entries then
  std::vector<LandmarkId> landmarks;
  Eigen::VectorXd mean;
  Eigen::MatrixXd information;  ///< inverse covariance
};

}  // namespace azimuth
