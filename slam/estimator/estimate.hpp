#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Whether the pose can be relied on.
enum class Health : std::uint8_t {
  starting,  ///< no landmark yet: the pose is odometry
  tracking,  ///< landmarks agree with the pose
  degraded,  ///< usable, but growing worse: see the reason
  lost       ///< do not steer by it
};

constexpr std::string_view to_string(Health health) {
  switch (health) {
    case Health::starting:
      return "starting";
    case Health::tracking:
      return "tracking";
    case Health::degraded:
      return "degraded";
    case Health::lost:
      return "lost";
  }
  return "?";
}

/// A mapped landmark in the map frame.
struct LandmarkEstimate {
  std::int64_t id = 0;                   ///< never reused within a run
  Identity identity = kUnknownIdentity;  ///< the sensor's name for it, when it gives one
  Eigen::Vector2d p_map_landmark_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  // Above the floor; NaN: mapped in the plane only.
  double z_map_landmark_m = std::numeric_limits<double>::quiet_NaN();
  double sigma_z_m = std::numeric_limits<double>::quiet_NaN();
};

/// A bearing that corrected the pose and the map in this step.
struct AcceptedSighting {
  std::int64_t landmark_id = 0;
  double azimuth_rad = 0.0;  ///< in the camera's frame
  double sigma_rad = 0.0;
  double radius_px = std::numeric_limits<double>::quiet_NaN();  ///< see Bearing
  // See Bearing; NaN: it corrected in the plane only.
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();
  double sigma_elevation_rad = std::numeric_limits<double>::quiet_NaN();
};

/// What became of the bearings so far, counted since the start of the run.
struct AssociationCounts {
  std::uint64_t accepted = 0;   ///< updated a mapped landmark
  std::uint64_t rejected = 0;   ///< failed a gate, or the joint test
  std::uint64_t ambiguous = 0;  ///< left out because two landmarks explained it equally well
  std::uint64_t thinned = 0;    ///< left out because too soon after the last one of the same landmark
  std::uint64_t created = 0;    ///< landmarks added to the map
  std::uint64_t deleted = 0;    ///< landmarks removed again
  std::uint64_t recovered = 0;  ///< landmarks or poses re-initialised after a streak of rejections
};

/// Samples that could not be used, counted since the start of the run.
struct InputCounts {
  std::uint64_t odometry_out_of_order = 0;
  std::uint64_t bearings_out_of_order = 0;
  std::uint64_t bearings_without_odometry = 0;  ///< no reading within the wait limit of their stamp
  std::uint64_t values_not_finite = 0;
  std::uint64_t odometry_gaps = 0;  ///< missing sequence numbers
  std::uint64_t bearing_gaps = 0;
};

/// Room that storage for a map starts with.
inline constexpr std::size_t kTypicalLandmarks = 256;

/// The outcome of one step.
///
/// Frames: `map` is fixed by the first pose; `odom` is the odometer's own frame, in which the pose never jumps.
struct Estimate {
  Stamp stamp{};               ///< of the bearings (or the odometry reading) the pose belongs to
  std::uint64_t sequence = 0;  ///< counts estimates
  std::uint64_t step = 0;      ///< counts filter steps (bearing sets used)
  bool predicted = false;      ///< odometry only since the last step; landmarks are those of that step
  Pose2 T_map_body;
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
  Pose2 T_odom_body;  ///< calibrated odometry at the same instant: smooth, drifting
  /// Those that images may show by mistake are left out until they were seen often enough.
  std::vector<LandmarkEstimate> landmarks;
  std::vector<AcceptedSighting> accepted;  ///< of the landmarks left out, too; empty when only predicted
  Health health = Health::starting;
  std::string_view reason;  ///< static text, why `health` is what it is; empty when tracking
  AssociationCounts association;
  InputCounts input;
};

}  // namespace azimuth
