#pragma once
// Internal to drivers/pioneer.

#include <optional>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// When the controller began to send the packets of a cycle. It looks at its wheels once and then sends one packet
/// after the other, so what comes last in a cycle is no younger than what comes first.
class CycleClock {
 public:
  /// Begin on the wire of the cycle that `packet` belongs to.
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
  static constexpr Clock::duration kLongest = std::chrono::milliseconds(50);  // on a full line cycles have no pauses
  Clock::time_point start_{};
  std::optional<Clock::time_point> last_byte_at_;
};

}  // namespace azimuth::pioneer
