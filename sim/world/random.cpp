#include "sim/world/random.hpp"

#include <cmath>

namespace azimuth {
namespace {

/// Spreads neighbouring seeds and purposes over all 64 bits.
std::uint64_t stream_seed(std::uint64_t seed, RandomPurpose purpose) {
  return mixed_bits(mixed_bits(seed + kGoldenBits) + kGoldenBits * static_cast<std::uint64_t>(purpose));
}

}  // namespace

Random::Random(std::uint64_t seed, RandomPurpose purpose)
    : RandomNumbers(std::mt19937_64(stream_seed(seed, purpose))) {}

// Knuth's product of uniform numbers.
int Random::poisson(double mean) {
  const double limit = std::exp(-mean);
  int count = 0;
  for (double product = uniform(); product > limit; product *= uniform()) ++count;
  return count;
}

std::size_t Random::index(std::size_t count) {
  return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}

}  // namespace azimuth
