#pragma once
#include <optional>

#include "slam/estimator/rig.hpp"

namespace azimuth {

/// What an estimator has found out about the rig it was given, and uses.
struct RigFinding {
  double bearing_noise = 1.0, odometry_noise = 1.0;  ///< Standard deviations relative to the rig's

  struct Value {
    double found = 0.0, sigma = 0.0;  ///< Value and standard deviation, in the units of the rig's key
  };
  // Only the values that the drive contradicts are set.
  std::optional<Value> yaw_offset_rad = {}, scale_turn = {}, drift_rad_per_m = {}, lag_s = {}, camera_ahead_m = {},
                       camera_left_m = {}, roll_rad = {}, pitch_rad = {};

  bool contradicts() const {
    return yaw_offset_rad || scale_turn || drift_rad_per_m || lag_s || camera_ahead_m || camera_left_m || roll_rad ||
           pitch_rad;
  }
};

/// Converts `errors`, found relative to `rig`, to the values that the rig's keys would have. `scale_turn_error` is
/// relative.
RigFinding by_keys(const Rig& rig, RigFinding errors, double scale_turn_error);

}  // namespace azimuth
