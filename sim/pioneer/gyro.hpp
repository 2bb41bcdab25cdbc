#pragma once
// The analogue rate gyro: measures the true rotation of the body, coarsely and with noise.

#include <vector>

#include "sim/pioneer/packets.hpp"
#include "sim/world/random.hpp"

namespace azimuth::sim {

/// Thread contract: thread-bound.
class Gyro {
 public:
  explicit Gyro(std::uint64_t seed) : random_(seed, RandomPurpose::gyro) {}

  void turn(double body_turn_rad) { turned_rad_ += body_turn_rad; }
  /// Samples the mean rate since the last sample, `period_s` ago.
  void sample(double period_s);
  /// Discards the rotation and the samples.
  void restart();
  /// The samples since the last call.
  std::vector<GyroSample> take();

 private:
  Random random_;
  double turned_rad_ = 0.0;
  std::vector<GyroSample> samples_;
};

}  // namespace azimuth::sim
