#pragma once
#include <cstdint>
#include <optional>

#include "drivers/pioneer/motion_packets.hpp"

namespace azimuth::pioneer {

/// What the wheels' ticks say of the motion over a while.
struct TickMotion {
  double distance_m = 0.0;
  std::optional<double> turn_rad;  ///< only with a calibrated number of ticks per turn
};

/// The motion in ticks, trusted once it has agreed with that of the standard SIP over a stretch: a wrong number of
/// ticks per millimetre, or a wheel that counts backwards, would scale the odometry silently.
///
/// Thread contract: thread-bound; never allocates.
class WheelTicks {
 public:
  /// `ticks_per_mm` 0: no ticks; `ticks_per_turn` 0: not calibrated.
  WheelTicks(double ticks_per_mm, double ticks_per_turn) : per_mm_(ticks_per_mm), per_turn_(ticks_per_turn) {}

  bool trusted() const { return trusted_; }
  /// The ticks came apart from the SIP's distance, or stopped coming.
  void distrust() {
    trusted_ = false;
    ticks_m_ = sip_m_ = path_m_ = 0.0;
  }

  /// The motion since the packet before, over which the SIP says the robot went `sip_forward_m` (backwards: negative).
  /// Nothing for the first, or when the two differ too much for a single one.
  std::optional<TickMotion> advance(const EncoderPacket& packet, double sip_forward_m);

 private:
  void compare(double ticks_m, double sip_m);

  double per_mm_, per_turn_;
  bool trusted_ = false;
  std::optional<EncoderPacket> last_;
  double ticks_m_ = 0.0, sip_m_ = 0.0, path_m_ = 0.0;  // over the present stretch
};

}  // namespace azimuth::pioneer
