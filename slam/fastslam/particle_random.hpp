#pragma once
#include <array>
#include <cstdint>

namespace azimuth {

/// A generator of its own (xoshiro256++ by Blackman & Vigna, seeded by splitmix64; normals by Marsaglia's polar
/// method), since the standard library does not say how its distributions are computed.
///
/// Thread contract: thread-bound. The same seed gives the same numbers.
class ParticleRandom {
 public:
  explicit ParticleRandom(std::uint64_t seed);

  std::uint64_t bits();
  double uniform();  ///< [0, 1)
  double normal();   ///< mean 0, standard deviation 1

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace azimuth
