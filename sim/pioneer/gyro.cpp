#include "sim/pioneer/gyro.hpp"

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

}  // namespace azimuth::sim
