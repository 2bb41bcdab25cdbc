#pragma once
// What a lost robot knows, as values: landmarks, and the directions in which it sees things.

#include <Eigen/Core>
#include <limits>
#include <numbers>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// A landmark that is mapped well enough to be recognised by where it is.
struct KnownLandmark {
  Eigen::Vector3d p_map_m = Eigen::Vector3d::Zero();  ///< z above the floor; NaN: mapped in the plane only
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;

  bool has_height() const { return p_map_m.z() == p_map_m.z(); }
};

/// A direction in the robot's frame: the camera's yaw and offsets are taken out.
struct SeenDirection {
  double azimuth_rad = 0.0;                                         ///< from the heading
  double sigma_rad = 0.0;                                           ///< positive
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();  ///< up from the horizontal; NaN: not measured
  double sigma_elevation_rad = std::numeric_limits<double>::quiet_NaN();
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
};

/// What the camera can see.
struct CameraView {
  double height_m = 0.0;  ///< above the floor
  double yaw_rad = 0.0;   ///< of the middle of the view
  double field_of_view_rad = 2.0 * std::numbers::pi;
  double min_elevation_rad = 0.0;      ///< where elevations are measured
  double rim = 0.1;                    ///< share of the view at its rim in which nothing counts as missed
  double max_distance_m = 15.0;        ///< in the plane
  double detection_probability = 0.0;  ///< of a landmark in view; 0: not known, and what is not seen says nothing
};

/// Whether the direction may be of the landmark, by their names and kinds.
inline bool may_be(const SeenDirection& seen, const KnownLandmark& landmark) {
  const bool named = seen.identity != kUnknownIdentity && landmark.identity != kUnknownIdentity;
  return (!named || seen.identity == landmark.identity) && same_kind(seen.kind, landmark.kind);
}

}  // namespace azimuth
