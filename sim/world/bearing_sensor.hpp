#pragma once
#include <vector>

#include "sim/world/random.hpp"
#include "sim/world/scene.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// A camera and its front end, reduced to what comes out of them.
struct BearingSensorSettings {
  double sigma_bearing_rad = 0.0261799387799;  ///< 1.5 deg
  double min_range_m = 0.2;                    ///< nearer landmarks are under the robot's own mounting
  double max_range_m = 6.0;
  double field_of_view_rad = 6.283185307179586;          ///< full angle, centred on the camera's zero azimuth
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< on the robot: forward, to the left
  double yaw_offset_rad = 0.0;                           ///< of the camera's zero azimuth from the heading
  double detection_probability = 1.0;
  double clutter_per_set = 0.0;  ///< mean number of bearings of nothing; uniform over the field of view
  bool identities = true;  ///< bearings carry the landmark's name; clutter then carries that of a landmark not seen
};

/// One set as seen from `T_world_body`, in the order of azimuth so that nothing can be learnt from the order. Stamp and
/// sequence are the caller's.
BearingSet observe(const std::vector<WorldLandmark>& landmarks, const Pose2& T_world_body,
                   const BearingSensorSettings& settings, Random& random);

}  // namespace azimuth
