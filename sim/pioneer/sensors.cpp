#include "sim/pioneer/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth::sim {
namespace {

// 10 bits for 5 V, 2.5 V for 300 deg/s, and the GyroScaler of the manufacturer's parameter files.
constexpr double kDegPerSPerCount = 5.0 / 1023 * (300 / 2.5) * 1.626;
constexpr double kCentre = 511.3;  // The rest count differs between gyros, so clients must estimate it
constexpr double kSigmaCounts = 0.6;
constexpr std::uint8_t kTemperature = 25;

}  // namespace

void Gyro::sample(double period_s) {
  const double rate_deg_per_s = rad_to_degrees(turned_rad_ / period_s);
  turned_rad_ = 0.0;
  // Clockwise rotation counts up.
  const double counts = kCentre - rate_deg_per_s / kDegPerSPerCount + random_.normal(kSigmaCounts);
  samples_.push_back({static_cast<std::uint16_t>(std::clamp(std::lround(counts), 0L, 1023L)), kTemperature});
}

void Gyro::restart() {
  turned_rad_ = 0.0;
  samples_.clear();
}

std::vector<GyroSample> Gyro::take() { return std::exchange(samples_, {}); }

std::vector<SonarReading> Sonar::ping(bool all) {
  constexpr std::uint16_t kNothing_mm = 5000;
  constexpr int kArrays = 2;  // The front and the rear array fire at the same time
  const int fired = std::min(model_.sonars, kArrays * model_.sip_cycle_ms / model_.sonar_cycle_ms);
  const int count = all ? model_.sonars : (on_ ? fired : 0);
  std::vector<SonarReading> readings;
  for (int i = 0; i < count; ++i) {
    readings.push_back({static_cast<std::uint8_t>(next_), kNothing_mm});
    next_ = (next_ + 1) % model_.sonars;
  }
  return readings;
}

}  // namespace azimuth::sim
