#include "sim/pioneer/sonar.hpp"

#include <algorithm>

namespace azimuth::sim {

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
