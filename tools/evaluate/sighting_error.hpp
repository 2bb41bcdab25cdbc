#pragma once
// Wrong identities without true ones: what the sightings of one landmark have in common, seen from where the robot
// really was, is a point; a sighting that does not point at it is of something else.

#include <cstdint>
#include <span>

#include "slam/sample/stamp.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// A bearing the estimator took for one of a landmark in its map.
struct SightingRecord {
  Stamp stamp{};
  std::int64_t landmark_id = 0;
  double azimuth_rad = 0.0;  ///< in the robot's frame
  double sigma_rad = 0.0;
};

/// Beyond four standard deviations a bearing may be off by this much more: truth is interpolated, and things have a
/// size.
inline constexpr double kSightingTolerance_rad = 0.0087;

struct SightingErrors {
  std::size_t judged = 0;  ///< of landmarks seen three times at least, under parallax, where there is truth
  std::size_t wrong = 0;   ///< that do not point at what most sightings of their landmark point at
};

SightingErrors sighting_errors(std::span<const SightingRecord> sightings, std::span<const StampedPose> truth,
                               const Eigen::Vector2d& p_body_camera_m = Eigen::Vector2d::Zero());

}  // namespace azimuth
