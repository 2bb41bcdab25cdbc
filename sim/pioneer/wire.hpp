#pragma once
// One direction of a serial line: bytes take their time, and some do not arrive as they were.

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "drivers/pioneer/packet.hpp"
#include "sim/pioneer/packets.hpp"
#include "sim/world/random.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Probabilities per byte.
struct WireNoise {
  double flip = 0.0;  ///< that one of its bits arrives wrong
  double lose = 0.0;  ///< that it does not arrive
};

/// 8N1: a byte takes ten bit times and counts as received when it is whole.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class Wire {
 public:
  explicit Wire(std::uint64_t seed) : random_(seed, RandomPurpose::line) {}

  WireNoise noise;

  /// Bytes handed to the sender at `now`; they leave one after the other behind those before.
  void send(pioneer::ByteView bytes, int baud, Stamp now);

  /// When the next byte will be whole; never is Stamp::max().
  Stamp due() const;

  /// Appends what a receiver at `baud` has made of the bytes that are whole by `now`. At another rate than the sender's
  /// that is garbage, more of it the faster the receiver; without a rate the receiver follows the sender.
  void receive(Stamp now, std::optional<int> baud, Bytes& received);

  std::size_t backlog() const { return bytes_.size(); }

 private:
  using Time = std::chrono::nanoseconds;  // since the start of virtual time; bit times are not whole microseconds
  struct InFlight {
    std::uint8_t byte;
    int baud;
    Time whole_at;
  };
  void arrive(const InFlight& byte, std::optional<int> baud, Bytes& received);
  void garble(const InFlight& byte, int baud, Bytes& received);

  Random random_;
  std::deque<InFlight> bytes_;
  Time free_at_{};
  double garbage_due_ = 0.0;  // fraction of a garbage byte in the receiver
};

}  // namespace azimuth::sim
