#pragma once
// The sensors of the controller besides the wheels.

#include <vector>

#include "sim/pioneer/model.hpp"
#include "sim/pioneer/packets.hpp"
#include "sim/world/random.hpp"

namespace azimuth::sim {

/// The analogue rate gyro: measures the true rotation of the body, coarsely and with noise.
///
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

/// The sonar's effect on the line: readings that take up room in SIPs. There are never any echoes.
///
/// Thread contract: thread-bound.
class Sonar {
 public:
  explicit Sonar(const PioneerModel& model) : model_(model) {}

  void switch_on(bool on) { on_ = on; }
  bool on() const { return on_; }
  /// The new readings of one SIP cycle: those whose turn it is, or all.
  std::vector<SonarReading> ping(bool all);

 private:
  PioneerModel model_;
  bool on_ = false;
  int next_ = 0;
};

}  // namespace azimuth::sim
