#include "slam/fastslam/lamp_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {

Reflections::Reflections(std::size_t count, double max_zenith_rad)
    : log_per_sr_(std::log(static_cast<double>(count) / (2.0 * kPi * (1.0 - std::cos(max_zenith_rad))))) {}

double Reflections::log_density(const LampSighting& seen) const {
  constexpr double kNearZenith = 0.01;
  return log_per_sr_ + std::log(std::max(seen.sin_zenith(), kNearZenith));
}

}  // namespace azimuth
