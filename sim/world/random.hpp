#pragma once
#include <cstddef>
#include <cstdint>
#include <random>

#include "slam/geometry/random.hpp"

namespace azimuth {

/// The purpose of a stream of random numbers. Each purpose has its own stream, so that for example the clutter rate of
/// a scenario affects neither its odometry noise nor its landmarks.
enum class RandomPurpose : std::uint64_t { scene = 1, drive = 2, odometry = 3, bearings = 4, line = 5, gyro = 6 };

/// Random numbers that are the same on every platform.
///
/// Thread contract: thread-bound.
class Random : public RandomNumbers<std::mt19937_64> {
 public:
  Random(std::uint64_t seed, RandomPurpose purpose);

  bool chance(double probability) { return uniform() < probability; }
  /// Poisson distributed; `mean` must not be negative and should be small, since the cost grows with it.
  int poisson(double mean);
  /// Uniformly distributed in [0, count); `count` must be positive.
  std::size_t index(std::size_t count);
};

}  // namespace azimuth
