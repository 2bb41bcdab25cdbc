#pragma once
// What stands in a world, and the way through it: landmark layouts and paths, in the world frame, metres.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/world/random.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

struct WorldLandmark {
  Identity identity = kUnknownIdentity;  ///< its true name, whether the sensor can read it or not
  Eigen::Vector2d p_world_landmark_m = Eigen::Vector2d::Zero();
};

struct Rectangle {
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_m = Eigen::Vector2d::Zero();
};

using Path = std::vector<Eigen::Vector2d>;  ///< corners, driven in order

/// Once round the rectangle per lap, counter-clockwise from its low corner, ending where it began.
Path laps_round(const Rectangle& rectangle, int laps);

/// There and back along a straight line, `laps` times.
Path there_and_back(const Eigen::Vector2d& start, const Eigen::Vector2d& end, int laps);

/// Random corners inside `area`, consecutive ones at least `min_leg_m` apart.
Path wander(const Rectangle& area, int corners, double min_leg_m, Random& random);

/// Distance from a point to the nearest point of the path.
double distance_to_path(const Eigen::Vector2d& point, const Path& path);

struct Spacing {
  double between_landmarks_m = 0.8;
  double from_path_m = 0.6;  ///< the robot must not drive over a landmark
};

/// Up to `count` landmarks at random in `area`, numbered from 0. Gives up on spacing that cannot be met and returns
/// fewer.
std::vector<WorldLandmark> scatter(const Rectangle& area, int count, const Spacing& spacing, const Path& path,
                                   Random& random);

/// Landmarks along the four walls of `room`, about `pitch_m` apart, each off its place by up to a quarter of that
/// along the wall and up to `depth_m` into the room.
std::vector<WorldLandmark> line_walls(const Rectangle& room, double pitch_m, double depth_m, Random& random);

}  // namespace azimuth
