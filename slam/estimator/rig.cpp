#include "slam/estimator/rig.hpp"

#include "slam/geometry/angle.hpp"

namespace azimuth {

RigFinding by_keys(const Rig& rig, RigFinding errors, double scale_turn_error) {
  const auto add_to = [](double said, std::optional<RigFinding::Value>& value) {
    if (value) value->found += said;
  };
  const double wider = 1.0 + scale_turn_error;
  add_to(rig.camera.yaw_offset_rad, errors.yaw_offset_rad);
  if (errors.yaw_offset_rad) errors.yaw_offset_rad->found = wrap(errors.yaw_offset_rad->found);
  if (errors.scale_turn) errors.scale_turn->found = rig.odometry.scale_turn * wider;
  add_to(rig.odometry.drift_rad_per_m * wider, errors.drift_rad_per_m);
  add_to(rig.odometry.lag_s, errors.lag_s);
  add_to(rig.camera.position_m[0], errors.camera_ahead_m);
  add_to(rig.camera.position_m[1], errors.camera_left_m);
  add_to(rig.camera.roll_rad, errors.roll_rad);
  add_to(rig.camera.pitch_rad, errors.pitch_rad);
  return errors;
}

}  // namespace azimuth
