#include "sim/world/random.hpp"

#include <cmath>

namespace azimuth {
namespace {

/// Spreads neighbouring seeds and purposes over all 64 bits (the finaliser of SplitMix64).
std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

std::uint64_t stream_seed(std::uint64_t seed, RandomPurpose purpose) {
  constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15ULL;
  return mix(mix(seed + kGoldenRatio) + kGoldenRatio * static_cast<std::uint64_t>(purpose));
}

}  // namespace

Random::Random(std::uint64_t seed, RandomPurpose purpose) : bits_(stream_seed(seed, purpose)) {}

double Random::uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

// Marsaglia's polar method: two independent normals from a point in the unit disc.
double Random::normal(double sigma) {
  if (has_spare_normal_) {
    has_spare_normal_ = false;
    return sigma * spare_normal_;
  }
  double x = 0.0, y = 0.0, squared = 0.0;
  do {
    x = uniform(-1.0, 1.0);
    y = uniform(-1.0, 1.0);
    squared = x * x + y * y;
  } while (squared >= 1.0 || squared == 0.0);
  const double scale = std::sqrt(-2.0 * std::log(squared) / squared);
  spare_normal_ = y * scale;
  has_spare_normal_ = true;
  return sigma * x * scale;
}

// Knuth's product of uniforms.
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
