#pragma once
// Landmark layouts and paths of a world, in the world frame, in metres.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/world/random.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

struct WorldLandmark {
  Identity identity = kUnknownIdentity;  ///< True identity, whether or not the sensor can read it
  Eigen::Vector2d p_world_landmark_m = Eigen::Vector2d::Zero();
};

struct Rectangle {
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_m = Eigen::Vector2d::Zero();
};

using Path = std::vector<Eigen::Vector2d>;  ///< Corners, driven in order

/// `laps` times round the rectangle, counter-clockwise from its low corner, ending at the start.
Path laps_round(const Rectangle& rectangle, int laps);

/// `laps` times there and back along a straight line.
Path there_and_back(const Eigen::Vector2d& start, const Eigen::Vector2d& end, int laps);

/// Random corners inside `area`, consecutive ones at least `min_leg_m` apart.
Path wander(const Rectangle& area, int corners, double min_leg_m, Random& random);

/// Distance from a point to the nearest point of the path.
double distance_to_path(const Eigen::Vector2d& point, const Path& path);

struct Spacing {
  double between_landmarks_m = 0.8;
  double from_path_m = 0.6;  ///< The robot must not drive over a landmark
};

/// Up to `count` landmarks at random in `area`, numbered from 0. Returns fewer if the spacing cannot be met.
std::vector<WorldLandmark> scatter(const Rectangle& area, int count, const Spacing& spacing, const Path& path,
                                   Random& random);

/// Landmarks along the four walls of `room`, about `pitch_m` apart, each displaced at random by up to a quarter of
/// `pitch_m` along the wall and up to `depth_m` into the room.
std::vector<WorldLandmark> line_walls(const Rectangle& room, double pitch_m, double depth_m, Random& random);

}  // namespace azimuth
