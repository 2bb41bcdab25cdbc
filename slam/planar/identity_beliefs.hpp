#pragma once
// What the filter believes about the landmarks it knows, as values for the search for identities.

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/planar/candidates.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

struct IdentityBeliefs {
  /// A landmark in the state, and where it is expected; NaN: it cannot be seen from here.
  struct Mapped {
    Identity identity = kUnknownIdentity;
    double azimuth_rad = std::numeric_limits<double>::quiet_NaN();    ///< in the camera's frame
    double variance_rad2 = std::numeric_limits<double>::quiet_NaN();  ///< of that, H P H^T: without a bearing's noise
  };
  /// An earlier bearing of a landmark not in the state yet.
  struct Sighted {
    Identity identity;
    Eigen::Vector2d p_map_camera_m;  ///< where it was taken
    double direction_rad;            ///< in the map frame
    double variance_rad2;            ///< of the bearing
    double variance_turn_rad2;       ///< of how far the robot has turned since
  };

  Pose2 T_map_camera;            ///< now
  bool anywhere = false;         ///< that pose is a guess: only looks say what is seen
  std::vector<Mapped> mapped;    ///< in the order of identities
  std::vector<Sighted> sighted;  ///< likewise
};

/// Replaces `out.sighted` and the pose; the mapped landmarks are the caller's.
void write_sighted(const BearingEkf& ekf, const Candidates& candidates, IdentityBeliefs& out);

}  // namespace azimuth
