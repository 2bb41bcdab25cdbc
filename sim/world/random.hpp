#pragma once
#include <cstddef>
#include <cstdint>
#include <random>

namespace azimuth {

/// What a stream of random numbers is used for. Each purpose draws from its own stream, so that changing the clutter
/// rate of a scenario changes neither its odometry noise nor its landmarks.
enum class RandomPurpose : std::uint64_t { scene = 1, drive = 2, odometry = 3, bearings = 4, line = 5, gyro = 6 };

/// Random numbers that are the same on every platform: the standard fixes the bits of std::mt19937_64, but not what
/// its distributions make of them.
///
/// Thread contract: thread-bound.
class Random {
 public:
  Random(std::uint64_t seed, RandomPurpose purpose);

  /// In [0, 1), 53 random bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Gaussian of mean 0; `sigma` may be 0. Draws the same amount whatever sigma is.
  double normal(double sigma);
  bool chance(double probability) { return uniform() < probability; }
  /// Poisson distributed; `mean` at least 0 and small (cost grows with it).
  int poisson(double mean);
  /// In [0, count); `count` positive.
  std::size_t index(std::size_t count);

 private:
  std::mt19937_64 bits_;
  double spare_normal_ = 0.0;
  bool has_spare_normal_ = false;
};

}  // namespace azimuth
