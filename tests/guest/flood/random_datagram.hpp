#pragma once
// What an open LCM network may throw at a subscriber.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace azimuth::guest {

using Octets = std::vector<std::uint8_t>;

/// Messages: of a known type with some bytes changed, cut off or added, or of no type at all. Same generator, same
/// bytes.
///
/// Thread contract: thread-bound.
class RandomMessages {
 public:
  explicit RandomMessages(std::uint64_t seed);
  const Octets& next();
  std::mt19937_64& random() { return random_; }

 private:
  void damage();

  std::mt19937_64 random_;
  std::vector<Octets> sound_;  // one of each type
  Octets message_;
};

/// A datagram that pretends to be one of LCM's, and is not as it should be: without a channel, a piece of a message
/// that contradicts itself or never ends, or noise. At most `kMostDatagramBytes`.
inline constexpr std::size_t kMostDatagramBytes = 1400;
void random_datagram(const std::string& channel, std::mt19937_64& random, Octets& into);

}  // namespace azimuth::guest
