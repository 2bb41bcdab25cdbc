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

  bool has_camera() const { return camera_.has_value(); }

  /// Of (azimuth, elevation) [rad^2]: what the bearing claims or else the noise of a pixel through the camera's model,
  /// which knows that an azimuth near the zenith says little.
  Eigen::Matrix2d covariance(const Bearing& bearing) const;

  /// In the robot's frame, as an image would show it whose centre is off by `centre_offset_px` (u, v). Without a camera
  /// model, and outside of its image, offsets change nothing.
  LampSeen seen(const Bearing& bearing, const Eigen::Vector2d& centre_offset_px) const;

  /// Where the camera shows what seen() would put at `direction`, in the camera's frame.
  Direction shown(const Direction& direction, const Eigen::Vector2d& centre_offset_px) const;

 private:
  CameraRig rig_;
  std::optional<CameraModel> camera_;
};

}  // namespace azimuth
