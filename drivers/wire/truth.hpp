#pragma once
// What is known of a run's truth; only for evaluation.

#include <limits>
#include <string>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Where the robot really was.
struct TruthPose {
  Stamp stamp{};
  Pose2 T_world_body;
  friend bool operator==(const TruthPose&, const TruthPose&) = default;
};

/// Where a landmark really is, in the world frame.
struct TrueLandmark {
  Identity identity = kUnknownIdentity;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not given
  std::string kind;                                       ///< "lamp", a colour; empty: not given
};

}  // namespace azimuth
