#pragma once
#include <optional>

#include "slam/estimator/rig.hpp"

namespace azimuth {

/// What an estimator has found out of the rig it was given, and goes by.
struct RigFinding {
  double bearing_noise = 1.0, odometry_noise = 1.0;  ///< standard deviations, times what the rig says

  struct Value {
    double found = 0.0, sigma = 0.0;  ///< as the rig's key would say it
  };
  // Of those that the drive contradicts.
  std::optional<Value> yaw_offset_rad = {}, scale_turn = {}, drift_rad_per_m = {}, lag_s = {}, camera_ahead_m = {},
                       camera_left_m = {}, roll_rad = {}, pitch_rad = {};

  bool contradicts() const {
    return yaw_offset_rad || scale_turn || drift_rad_per_m || lag_s || camera_ahead_m || camera_left_m || roll_rad ||
           pitch_rad;
  }
};

/// As the keys of `rig` would say it, what is found as errors: by how much more there is than the rig says, and of
/// turns as a share.
RigFinding by_keys(const Rig& rig, RigFinding errors, double scale_turn_error);

}  // namespace azimuth
