#pragma once
// A robot that is not as the estimators think robots are: two wheels with encoders, which slip for seconds at a time
// and more in turns, a carpet that pulls to one side, stamps that jitter, and bearings whose errors have heavy tails.
// What the rig says is what fits at `bearing_noise` and `odometry_noise` 1 and no mounting errors.

#include <Eigen/Core>
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

struct EncoderRobot {
  std::uint64_t seed = 1;
  int laps = 2;                 ///< of a room of 9 x 7 m
  double bearing_noise = 1.0;   ///< standard deviations, times the rig's
  double odometry_noise = 1.0;  ///< likewise
  double camera_yaw_rad = 0.0;  ///< unknown to the rig, all of these
  Eigen::Vector2d p_body_camera_m = Eigen::Vector2d::Zero();
  double scale_turn = 1.0;   ///< odometry says this times the turn
  double image_lag_s = 0.0;  ///< images are so much older than stamped
};

Run driven(const EncoderRobot& robot);

}  // namespace azimuth
