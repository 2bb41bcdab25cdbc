#pragma once
// Input of the search for a lost robot, as plain values: landmarks and measured directions.

#include <Eigen/Core>
#include <limits>
#include <numbers>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// A landmark that is mapped well enough to be recognised by its position.
struct KnownLandmark {
  Eigen::Vector3d p_map_m = Eigen::Vector3d::Zero();  ///< z above the floor; NaN: mapped in the plane only
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;

  bool has_height() const { return p_map_m.z() == p_map_m.z(); }
};

/// A direction in the robot's frame, corrected for the camera's yaw and offsets.
struct SeenDirection {
  double azimuth_rad = 0.0;                                         ///< Azimuth from the heading
  double sigma_rad = 0.0;                                           ///< Positive
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();  ///< Up from the horizontal; NaN: not measured
  double sigma_elevation_rad = std::numeric_limits<double>::quiet_NaN();
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
};

/// Field of view and range of the camera.
struct CameraView {
  double height_m = 0.0;  ///< Height above the floor
  double yaw_rad = 0.0;   ///< Azimuth of the middle of the view
  double field_of_view_rad = 2.0 * std::numbers::pi;
  double min_elevation_rad = 0.0;  ///< Lower limit of the view, where elevations are measured
  double rim = 0.1;                ///< Share of the view at its rim in which no landmark counts as missed
  double max_distance_m = 15.0;    ///< Range in the plane
  /// Probability that a landmark in view is detected; 0: unknown; then landmarks that are not seen do not count against
  /// a pose
  double detection_probability = 0.0;
};

/// Whether names and kinds allow the direction to belong to the landmark.
inline bool may_be(const SeenDirection& seen, const KnownLandmark& landmark) {
  const bool named = seen.identity != kUnknownIdentity && landmark.identity != kUnknownIdentity;
  return (!named || seen.identity == landmark.identity) && same_kind(seen.kind, landmark.kind);
}

}  // namespace azimuth
