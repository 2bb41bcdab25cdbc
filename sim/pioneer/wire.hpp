#pragma once
// One direction of a serial line: bytes take time, and some arrive damaged or are lost.

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
  double flip = 0.0;  ///< Probability that one bit of the byte is flipped
  double lose = 0.0;  ///< Probability that the byte is lost
};

/// 8N1: a byte takes ten bit times and is received when it is complete.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class Wire {
 public:
  explicit Wire(std::uint64_t seed) : random_(seed, RandomPurpose::line) {}

  WireNoise noise;

  /// Hands bytes to the sender at `now`; they are sent one after the other, after earlier ones.
  void send(pioneer::ByteView bytes, int baud, Stamp now);

  /// Instant at which the next byte is complete; Stamp::max() if there is none.
  Stamp due() const;

  /// Appends what a receiver at `baud` makes of the bytes that are complete by `now`. At another rate than the
  /// sender's, the receiver gets garbage: the higher its rate, the more bytes. Without a rate, the receiver follows the
  /// sender.
  void receive(Stamp now, std::optional<int> baud, Bytes& received);

  std::size_t backlog() const { return bytes_.size(); }

 private:
  using Time = std::chrono::nanoseconds;  // Since the start of virtual time; bit times are not whole microseconds
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
  double garbage_due_ = 0.0;  // Fraction of a garbage byte in the receiver
};

}  // namespace azimuth::sim
