#pragma once
// The filter's belief of its landmarks, as plain values for assigning identities to features.

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/planar/candidates.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

struct IdentityBeliefs {
  /// A landmark in the state and its expected azimuth; NaN: it cannot be seen from here.
  struct Mapped {
    Identity identity = kUnknownIdentity;
    double azimuth_rad = std::numeric_limits<double>::quiet_NaN();  ///< in the camera's frame
    /// Variance H P H^T of the azimuth, without a bearing's noise
    double variance_rad2 = std::numeric_limits<double>::quiet_NaN();
  };
  /// An earlier bearing of a landmark that is not in the state yet.
  struct Sighted {
    Identity identity;
    Eigen::Vector2d p_map_camera_m;  ///< The place from which the bearing was taken
    double direction_rad;            ///< Direction of the bearing in the map frame
    double variance_rad2;            ///< Noise of the bearing
    double variance_turn_rad2;       ///< Variance of the robot's change of heading since the bearing
  };

  Pose2 T_map_camera;            ///< Present pose of the camera
  bool anywhere = false;         ///< The pose is a guess: only descriptors decide
  std::vector<Mapped> mapped;    ///< Sorted by identity
  std::vector<Sighted> sighted;  ///< Sorted by identity
};

/// Replaces `out.sighted` and the pose; the caller fills in the mapped landmarks.
void write_sighted(const BearingEkf& ekf, const Candidates& candidates, IdentityBeliefs& out);

}  // namespace azimuth
