#pragma once
#include <cstddef>
#include <cstdint>
#include <random>

#include "slam/geometry/random.hpp"

namespace azimuth {

/// What a stream of random numbers is used for. Each purpose draws from its own stream, so that changing the clutter
/// rate of a scenario changes neither its odometry noise nor its landmarks.
enum class RandomPurpose : std::uint64_t { scene = 1, drive = 2, odometry = 3, bearings = 4, line = 5, gyro = 6 };

/// Random numbers that are the same on every platform.
///
/// Thread contract: thread-bound.
class Random : public RandomNumbers<std::mt19937_64> {
 public:
  Random(std::uint64_t seed, RandomPurpose purpose);

  bool chance(double probability) { return uniform() < probability; }
  /// Poisson distributed; `mean` at least 0 and small (cost grows with it).
  int poisson(double mean);
  /// In [0, count); `count` positive.
  std::size_t index(std::size_t count);
};

}  // namespace azimuth
