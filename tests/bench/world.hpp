#pragma once
// One world for all benchmarks: ten landmarks around the robot, visible in every step, and the rest of the map out of
// sight. The time of a step then depends only on the size of the map.

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::bench {

inline constexpr int kSeen = 10;
inline constexpr double kSightRange_m = 5.0;  ///< seen landmarks are nearer, the others are beyond 3 times this range
inline constexpr double kStride_m = 0.05;     ///< forwards and backwards in turn
inline constexpr double kBaseline_m = 10.0;   ///< distance between the two poses that initialise the map
inline constexpr double kSigmaBearing_rad = 0.01;

/// `count` landmarks (at least kSeen) in the map frame, the seen ones first.
std::vector<Eigen::Vector2d> make_landmarks(int count);

/// Azimuth of `p_map` relative to the robot's heading.
double azimuth_to(const Pose2& T_map_body, const Eigen::Vector2d& p_map);

/// A straight drive, forwards or backwards, as measured by good odometry.
Motion straight(double distance_m);

}  // namespace azimuth::bench
