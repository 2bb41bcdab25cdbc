#pragma once
// One world for all benchmarks: ten landmarks about the robot, which every step sees, and the rest of the map out of
// sight. What a step costs then depends on the size of the map alone.

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::bench {

inline constexpr int kSeen = 10;
inline constexpr double kSightRange_m =
    5.0;                                   ///< the seen landmarks are nearer than this, the others beyond 3 times that
inline constexpr double kStride_m = 0.05;  ///< the robot drives this far, forwards and backwards by turns
inline constexpr double kBaseline_m = 10.0;  ///< between the two poses the map is made from
inline constexpr double kSigmaBearing_rad = 0.01;

/// `count` landmarks in the map frame, the seen ones first. At least kSeen.
std::vector<Eigen::Vector2d> make_landmarks(int count);

/// The direction to `p_map` from the robot's heading.
double azimuth_to(const Pose2& T_map_body, const Eigen::Vector2d& p_map);

/// A drive straight on, or backwards, as good odometry tells it.
Motion straight(double distance_m);

}  // namespace azimuth::bench
