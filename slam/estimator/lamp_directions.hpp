#pragma once
#include <Eigen/Core>
#include <optional>

#include "slam/camera/camera_model.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

// Where the rig does not say.
inline constexpr double kUnknownHeight_m = 0.0;  ///< the map's heights are then above the camera
inline constexpr double kUsualDetection = 0.85;  ///< probability that a lamp in view is detected

/// What the rig knows of bearings that carry an elevation.
///
/// Thread contract: reentrant.
class LampDirections {
 public:
  explicit LampDirections(const Rig& rig);

  const std::optional<CameraModel>& camera() const { return camera_; }

  /// Of (azimuth, elevation) [rad^2]: what the bearing claims or else the noise of a pixel through the camera's model,
  /// which knows that an azimuth near the zenith says little.
  Eigen::Matrix2d covariance(const Bearing& bearing) const;

  /// In the robot's frame, as a camera sees it that is off by `errors` (CameraErrors::mean, the centre's along u and
  /// v). Without a camera model, and outside of its image, errors change nothing.
  LampSeen seen(const Bearing& bearing, const Eigen::Vector4d& errors) const;

  /// Where the camera shows what seen() would put at `direction`, in the camera's frame.
  Direction shown(const Direction& direction, const Eigen::Vector4d& errors) const;

 private:
  CameraModel leaning(const Eigen::Vector4d& errors) const;

  CameraRig rig_;
  std::optional<CameraModel> camera_;
};

}  // namespace azimuth
