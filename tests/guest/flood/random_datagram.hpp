#pragma once
// Random messages and datagrams, as a subscriber may receive them on an open LCM network.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace azimuth::guest {

using Octets = std::vector<std::uint8_t>;

/// Random messages: messages of a known type with changed, missing or additional bytes, and noise. Equal seeds give
/// equal bytes.
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
  std::vector<Octets> sound_;  // one sound message of each type
  Octets message_;
};

/// A malformed LCM datagram: without a channel, a fragment of an inconsistent or endless message, or noise. It has at
/// most `kMostDatagramBytes`.
inline constexpr std::size_t kMostDatagramBytes = 1400;
void random_datagram(const std::string& channel, std::mt19937_64& random, Octets& into);

}  // namespace azimuth::guest
