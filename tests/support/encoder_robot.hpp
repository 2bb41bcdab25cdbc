#pragma once
// A robot that is not as the estimators think robots are: two wheels with encoders, which slip for seconds at a time
// and more in turns, a carpet that pulls to one side, stamps that jitter, and bearings whose errors have heavy tails.
// What the rig says is what fits at `bearing_noise` and `odometry_noise` 1 and no mounting errors.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// A robot is lifted, with its wheels standing still, and set down elsewhere.
struct Carrying {
  bool next_door = true;       ///< into a room with other landmarks; else into the first room
  bool camera_covered = true;  ///< meanwhile
};

struct EncoderRobot {
  std::uint64_t seed = 1;
  int laps = 2;                 ///< of a room of 9 x 7 m, and again after each carrying
  double bearing_noise = 1.0;   ///< standard deviations, times the rig's
  double odometry_noise = 1.0;  ///< likewise
  double camera_yaw_rad = 0.0;  ///< unknown to the rig, all of these
  Eigen::Vector2d p_body_camera_m = Eigen::Vector2d::Zero();
  double scale_turn = 1.0;       ///< odometry says this times the turn
  double drift_rad_per_m = 0.0;  ///< the robot turns so much more than odometry says for each metre
  double image_lag_s = 0.0;      ///< images are so much older than stamped
  double stands_s = 0.0;         ///< in the middle, and
  double creeps_m_per_s = 0.0;   ///< what odometry says of it then
  bool names = true;             ///< else bearings say not of what they are
  std::vector<Carrying> carried = {};
};

/// Where a `set_down` is asked for, it is given the instants at which the robot is set down.
Run driven(const EncoderRobot& robot, std::vector<Stamp>* set_down = nullptr);

}  // namespace azimuth
