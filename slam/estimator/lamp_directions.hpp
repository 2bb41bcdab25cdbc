#pragma once
#include <Eigen/Core>
#include <optional>

#include "slam/camera/camera_model.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

// Defaults for values that the rig does not give.
inline constexpr double kUnknownHeight_m = 0.0;  ///< Heights in the map then count from the camera
inline constexpr double kUsualDetection = 0.85;  ///< Probability that a lamp in view is detected

/// Converts bearings with elevations to directions in the robot's frame, using the rig's camera.
///
/// Thread contract: reentrant.
class LampDirections {
 public:
  explicit LampDirections(const Rig& rig);

  const std::optional<CameraModel>& camera() const { return camera_; }

  /// Covariance of (azimuth, elevation) [rad^2]: the bearing's own if it carries one, else the pixel noise propagated
  /// through the camera's model. The model accounts for the poorly known azimuth near the zenith.
  Eigen::Matrix2d covariance(const Bearing& bearing) const;

  /// The direction in the robot's frame, corrected for the camera errors `errors` (laid out as CameraErrors::mean, the
  /// centre along u and v). Without a camera model, and outside of its image, errors change nothing.
  LampSeen seen(const Bearing& bearing, const Eigen::Vector4d& errors) const;

  /// Inverse of seen(): the direction in the camera's frame whose correction is `direction`.
  Direction shown(const Direction& direction, const Eigen::Vector4d& errors) const;

 private:
  CameraModel leaning(const Eigen::Vector4d& errors) const;

  CameraRig rig_;
  std::optional<CameraModel> camera_;
};

}  // namespace azimuth
