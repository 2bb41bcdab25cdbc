#pragma once
// Internal to drivers/pioneer.

#include <optional>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// Determines when the controller began to send the packets of a cycle. The controller reads its wheels once per cycle
/// and then sends the packets one after the other, so all packets of a cycle have the same age.
class CycleClock {
 public:
  /// The time at which the cycle of `packet` began on the wire.
  Clock::time_point start_of(const Packet& packet, Clock::duration byte_time) {
    const auto first = packet.first_byte_at;
    const bool goes_on = last_byte_at_ && first - *last_byte_at_ <= kPause && first - start_ <= kLongest;
    if (!goes_on) start_ = first - byte_time;
    const auto following = static_cast<Clock::rep>(packet.data.size() + kFrameOverhead - 1);
    last_byte_at_ = first + byte_time * following;
    return start_;
  }

 private:
  static constexpr Clock::duration kPause = std::chrono::milliseconds(5);
  // Longest time that counts as one cycle, because a fully loaded line has no pauses between cycles.
  static constexpr Clock::duration kLongest = std::chrono::milliseconds(50);
  Clock::time_point start_{};
  std::optional<Clock::time_point> last_byte_at_;
};

}  // namespace azimuth::pioneer
