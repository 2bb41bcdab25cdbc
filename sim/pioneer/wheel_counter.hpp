#pragma once
// The controller's dead reckoning: whole encoder ticks in, quantised position out.

#include <cstdint>

#include "sim/pioneer/model.hpp"

namespace azimuth::sim {

/// Motion of the wheels and of the robot's body. The wheels may slip; the gyro measures the body's own rotation.
struct WheelMotion {
  double left_m = 0.0;
  double right_m = 0.0;
  double body_turn_rad = 0.0;
};

/// XPOS, YPOS and THPOS as in a SIP.
struct RawPose {
  std::uint16_t x = 0, y = 0;
  std::int16_t heading = 0;
  friend bool operator==(const RawPose&, const RawPose&) = default;
};

/// The heading as in THPOS: kHeadingCounts a turn. `heading_rad` must be in [-pi, pi).
std::int16_t heading_count(double heading_rad);

/// Thread contract: thread-bound.
class WheelCounter {
 public:
  explicit WheelCounter(const PioneerModel& model) : model_(model) {}

  /// Distances in whole ticks.
  struct Travel {
    double left_mm = 0.0, right_mm = 0.0;
  };
  /// Adds the motion; returns the counted part.
  Travel roll(const WheelMotion& motion);

  /// Resets x, y and heading, to zero or to values from which an overflow occurs soon. The tick counters continue.
  void reset_pose() { reset_pose(0.0, 0.0, 0.0); }
  void reset_pose(double x_units, double y_units, double heading_rad);

  RawPose raw(int position_bits) const;
  std::int32_t left_ticks() const { return wrapped(left_.ticks); }
  std::int32_t right_ticks() const { return wrapped(right_.ticks); }
  double heading_rad() const { return heading_rad_; }

  /// Motion since the last call, for velocities.
  Travel take_travel();

 private:
  struct Encoder {
    double ticks_exact = 0.0;
    std::int64_t ticks = 0;        // Number of whole ticks
    std::int64_t ticks_taken = 0;  // Number of whole ticks at the last call of take_travel()
    double advance(double ticks_more);
  };
  static std::int32_t wrapped(std::int64_t ticks) { return static_cast<std::int32_t>(ticks); }

  PioneerModel model_;
  Encoder left_, right_;
  double x_mm_ = 0.0, y_mm_ = 0.0, heading_rad_ = 0.0;
};

}  // namespace azimuth::sim
