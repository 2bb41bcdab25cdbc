#pragma once
// Detects wrong data associations without true identities. From the true poses of the robot, all bearings of one
// landmark intersect in a point. A bearing that misses this point belongs to another landmark.

#include <cstdint>
#include <span>

#include "slam/sample/stamp.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// A bearing that the estimator assigned to a landmark of its map.
struct SightingRecord {
  Stamp stamp{};
  std::int64_t landmark_id = 0;
  double azimuth_rad = 0.0;  ///< in the robot's frame
  double sigma_rad = 0.0;
};

/// Tolerance of a bearing in addition to four standard deviations, since truth is interpolated and landmarks have a
/// size.
inline constexpr double kSightingTolerance_rad = 0.0087;

struct SightingErrors {
  std::size_t judged = 0;  ///< bearings with truth, of landmarks with at least three bearings and enough parallax
  std::size_t wrong = 0;   ///< judged bearings that miss the point at which most bearings of their landmark aim
};

SightingErrors sighting_errors(std::span<const SightingRecord> sightings, std::span<const StampedPose> truth,
                               const Eigen::Vector2d& p_body_camera_m = Eigen::Vector2d::Zero());

}  // namespace azimuth
