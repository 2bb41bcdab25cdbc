#pragma once
// A robot that violates the assumptions of the estimators: two wheels with encoders that slip for seconds at a time and
// more in turns, a carpet that pulls to one side, jittering stamps, and heavy-tailed bearing errors. The rig is correct
// if `bearing_noise` and `odometry_noise` are 1 and all mounting errors are 0.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// Somebody lifts the robot, while its wheels stand still, and sets it down at another place.
struct Carrying {
  bool next_door = true;       ///< carried into a room with other landmarks; false: set down in the first room
  bool camera_covered = true;  ///< the camera sees nothing while the robot is carried
};

struct EncoderRobot {
  std::uint64_t seed = 1;
  int laps = 2;                 ///< in a room of 9 x 7 m, at the start and again after each carrying
  double bearing_noise = 1.0;   ///< factor on the rig's standard deviation
  double odometry_noise = 1.0;  ///< factor on the noise of the odometry
  double camera_yaw_rad = 0.0;  ///< the rig knows neither this nor any of the errors below
  Eigen::Vector2d p_body_camera_m = Eigen::Vector2d::Zero();
  double scale_turn = 1.0;       ///< factor on each turn that odometry reports
  double drift_rad_per_m = 0.0;  ///< the robot turns so much more per metre than odometry reports
  double image_lag_s = 0.0;      ///< true age of the images relative to their stamps
  double stands_s = 0.0;         ///< time for which the robot stands still in the middle of the drive
  double creeps_m_per_s = 0.0;   ///< speed that odometry reports while the robot stands
  bool names = true;             ///< false: bearings have no identities
  std::vector<Carrying> carried = {};
};

/// If `set_down` is given, it receives the instants at which the robot is set down.
Run driven(const EncoderRobot& robot, std::vector<Stamp>* set_down = nullptr);

}  // namespace azimuth
