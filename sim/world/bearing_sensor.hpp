#pragma once
#include <vector>

#include "sim/world/random.hpp"
#include "sim/world/scene.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

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
