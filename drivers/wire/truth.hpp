#pragma once
// The truth of a run; only for evaluation.

#include <limits>
#include <string>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The true pose of the robot.
struct TruthPose {
  Stamp stamp{};
  Pose2 T_world_body;
  friend bool operator==(const TruthPose&, const TruthPose&) = default;
};

/// The true position of a landmark in the world frame.
struct TrueLandmark {
  Identity identity = kUnknownIdentity;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unknown
  std::string kind;                                       ///< "lamp", or a colour; empty: unknown
};

}  // namespace azimuth
