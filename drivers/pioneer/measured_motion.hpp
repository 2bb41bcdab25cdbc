#pragma once
// The motion of the robot by its wheels' ticks and its gyro.

#include <cstdint>
#include <optional>

#include "drivers/pioneer/motion_packets.hpp"

namespace azimuth::pioneer {

/// The motion measured by the wheels' ticks.
struct TickMotion {
  double distance_m = 0.0;
  std::optional<double> turn_rad;  ///< only with a calibrated number of ticks per turn
};

/// The motion in wheel ticks. It is trusted once it has agreed with the motion of the standard SIP over some distance,
/// because a wrong number of ticks per millimetre, or a wheel that counts backwards, would silently scale the odometry.
///
/// Thread contract: thread-bound; never allocates.
class WheelTicks {
 public:
  /// `ticks_per_mm` 0: no ticks; `ticks_per_turn` 0: not calibrated.
  WheelTicks(double ticks_per_mm, double ticks_per_turn) : per_mm_(ticks_per_mm), per_turn_(ticks_per_turn) {}

  bool trusted() const { return trusted_; }
  /// To be called when the ticks disagree with the SIP's distance, or stop arriving.
  void distrust() {
    trusted_ = false;
    ticks_m_ = sip_m_ = path_m_ = 0.0;
  }

  /// The motion since the previous packet, over which the SIP reports a distance of `sip_forward_m` (negative:
  /// backwards). None for the first packet, or when the two differ too much in a single step.
  std::optional<TickMotion> advance(const EncoderPacket& packet, double sip_forward_m);

 private:
  void compare(double ticks_m, double sip_m);

  double per_mm_, per_turn_;
  bool trusted_ = false;
  std::optional<EncoderPacket> last_;
  double ticks_m_ = 0.0, sip_m_ = 0.0,
         path_m_ = 0.0;  // lengths by ticks, by SIP and of the path, over the current stretch
};

/// The turn measured by the analog gyro. The gyro's rate at rest is learned while the robot stands still.
///
/// Thread contract: thread-bound; never allocates.
class GyroTurn {
 public:
  /// `scale` is RobotParameters::gyro_scale.
  explicit GyroTurn(double scale);

  void add(const GyroPacket& packet);
  /// Tells whether the wheels stood still over the last `elapsed_s`, the time of the samples since the last note.
  void note_standing(bool standing, double elapsed_s);

  /// The counter-clockwise turn since the last take. None while the rate at rest is unknown, or when samples are
  /// missing in the `elapsed_s` since then.
  std::optional<double> take_rad(double elapsed_s);

 private:
  double rad_per_count_;
  double sum_ = 0.0;  // sum of the rates since the last take
  int count_ = 0;
  double rest_sum_ = 0.0, rest_s_ = 0.0;  // sum of the rates at rest, and its time
  int rest_count_ = 0;
  double new_sum_ = 0.0;  // sum of the rates since the last note
  int new_count_ = 0;
  std::optional<double> rate_at_rest_;
};

/// Combines the turns measured by wheels and gyro, weighted by their inverse variances.
struct FusedTurn {
  double turn_rad = 0.0;
  bool skid = false;  ///< the gyro turned but the wheels did not: the gyro is used
};
FusedTurn fuse_turns(double wheels_rad, double gyro_rad, double elapsed_s);

}  // namespace azimuth::pioneer
