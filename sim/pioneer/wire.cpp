#include "sim/pioneer/wire.hpp"

#include <algorithm>

namespace azimuth::sim {
namespace {

constexpr std::int64_t kBitsPerByte = 10;

}  // namespace

void Wire::send(pioneer::ByteView bytes, int baud, Stamp now) {
  free_at_ = std::max<Time>(free_at_, now.time_since_epoch());
  for (const std::uint8_t byte : bytes) {
    free_at_ += Time(kBitsPerByte * 1'000'000'000 / baud);
    bytes_.push_back({byte, baud, free_at_});
  }
}

Stamp Wire::due() const {
  if (bytes_.empty()) return Stamp::max();
  return Stamp(std::chrono::ceil<Duration>(bytes_.front().whole_at));
}

void Wire::receive(Stamp now, std::optional<int> baud, Bytes& received) {
  while (due() <= now) {
    arrive(bytes_.front(), baud, received);
    bytes_.pop_front();
  }
}

void Wire::arrive(const InFlight& byte, std::optional<int> baud, Bytes& received) {
  if (noise.lose > 0.0 && random_.chance(noise.lose)) return;
  if (baud && *baud != byte.baud) return garble(byte, *baud, received);
  const bool flipped = noise.flip > 0.0 && random_.chance(noise.flip);
  const auto bit = static_cast<std::uint8_t>(flipped ? 1U << random_.index(8) : 0U);
  received.push_back(byte.byte ^ bit);
}

/// A faster receiver reads the bits of one byte as several bytes, a slower one those of several bytes as one.
void Wire::garble(const InFlight& byte, int baud, Bytes& received) {
  for (garbage_due_ += static_cast<double>(baud) / byte.baud; garbage_due_ >= 1.0; garbage_due_ -= 1.0) {
    received.push_back(static_cast<std::uint8_t>(random_.index(256)));
  }
}

}  // namespace azimuth::sim
