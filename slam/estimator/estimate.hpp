#pragma once
#include <Eigen/Core>
#include <algorithm>
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
  starting,  ///< No landmark is mapped yet: the pose is odometry alone
  tracking,  ///< Landmarks agree with the pose
  degraded,  ///< The pose is usable, but grows worse: see Estimate::reason
  lost       ///< The robot must not be steered by this pose
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
  std::int64_t id = 0;                   ///< Never reused within a run
  Identity identity = kUnknownIdentity;  ///< The name that the sensor gives to the landmark, if it gives one
  Eigen::Vector2d p_map_landmark_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  // Height above the floor; NaN: the landmark is mapped in the plane only.
  double z_map_landmark_m = std::numeric_limits<double>::quiet_NaN();
  double sigma_z_m = std::numeric_limits<double>::quiet_NaN();
};

/// A bearing that corrected the pose and the map in this step.
struct AcceptedSighting {
  std::int64_t landmark_id = 0;
  double azimuth_rad = 0.0;  ///< Azimuth in the camera's frame
  double sigma_rad = 0.0;
  /// Distance of the bearing from the image's centre; NaN: the bearing is not from an image.
  double radius_px = std::numeric_limits<double>::quiet_NaN();
  // The elevation above the horizontal and its standard deviation. They are NaN if the estimator used only the azimuth.
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();
  double sigma_elevation_rad = std::numeric_limits<double>::quiet_NaN();
};

/// What became of the bearings, counted since the start of the run.
struct AssociationCounts {
  std::uint64_t accepted = 0;   ///< Bearings that updated a mapped landmark
  std::uint64_t rejected = 0;   ///< Bearings that failed a gate or the joint test
  std::uint64_t ambiguous = 0;  ///< Bearings left out because two landmarks explained them equally well
  std::uint64_t thinned = 0;    ///< Bearings left out because the last one of the same landmark was too recent
  std::uint64_t created = 0;    ///< Landmarks added to the map
  std::uint64_t deleted = 0;    ///< Landmarks removed from the map
  std::uint64_t recovered = 0;  ///< Landmarks or poses re-initialised after a streak of rejections
};

/// Samples that could not be used, counted since the start of the run.
struct InputCounts {
  std::uint64_t odometry_out_of_order = 0;
  std::uint64_t bearings_out_of_order = 0;
  std::uint64_t bearings_without_odometry = 0;  ///< Bearing sets without a reading within the wait limit of their stamp
  std::uint64_t values_not_finite = 0;
  std::uint64_t odometry_gaps = 0;  ///< Missing sequence numbers
  std::uint64_t bearing_gaps = 0;
};

/// Initial capacity of storage for landmarks.
inline constexpr std::size_t kTypicalLandmarks = 256;

/// The outcome of one step.
///
/// Frames: `map` is fixed by the first pose; `odom` is the odometer's own frame, in which the pose never jumps.
struct Estimate {
  Stamp stamp{};               ///< Instant of the pose: that of the bearings, or of the odometry reading
  std::uint64_t sequence = 0;  ///< Counts estimates
  std::uint64_t step = 0;      ///< Counts filter steps (bearing sets used)
  bool predicted = false;      ///< The pose is odometry since the last step; landmarks are those of that step
  Pose2 T_map_body;
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
  Pose2 T_odom_body;  ///< Calibrated odometry at the same instant: smooth, drifting
  /// Landmarks that may be false detections are left out until they were seen often enough.
  std::vector<LandmarkEstimate> landmarks;
  /// Includes bearings of landmarks left out of `landmarks`; empty when `predicted`
  std::vector<AcceptedSighting> accepted;
  Health health = Health::starting;
  std::string_view reason;  ///< Static text: why `health` is what it is; empty when tracking
  AssociationCounts association;
  InputCounts input;
};

/// The robot's pose at a past instant, by everything that was seen until now.
struct PastPose {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
};

/// A past pose without its covariance.
struct PathPose {
  Stamp stamp{};
  Pose2 T_map_body;
};

/// Writes the ids of an estimate's landmarks, ascending, into `out`, reusing its storage. User output numbers landmarks
/// by their place in this order, so that a map of two dozen landmarks has no three-digit numbers.
inline void ids_of(const std::vector<LandmarkEstimate>& landmarks, std::vector<std::int64_t>& out) {
  out.clear();
  for (const LandmarkEstimate& landmark : landmarks) out.push_back(landmark.id);
  std::ranges::sort(out);
}

}  // namespace azimuth
