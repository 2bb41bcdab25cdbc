#include "tests/robot/agreement.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace azimuth::test {

Agreement agreement(std::span<const Sighting> sightings) {
  Agreement result;
  const Sighting* first = nullptr;
  for (const Sighting& sighting : sightings) {
    ++result.readings;
    if (first == nullptr || sighting.reading.origin != first->reading.origin) {
      first = &sighting;
      ++result.origins;
    }
    const Pose2 T_first_wheels = inverse(first->T_odom_wheels) * sighting.T_odom_wheels;
    const Pose2 T_first_driver = inverse(first->reading.T_odom_body) * sighting.reading.T_odom_body;
    const double error_m = (T_first_driver.position() - T_first_wheels.position()).norm();
    const double explained_m = kHeadingUnit_rad * T_first_wheels.position().norm();
    result.worst_m = std::max(result.worst_m, error_m);
    result.worst_excess_m = std::max(result.worst_excess_m, error_m - explained_m);
    result.worst_rad =
        std::max(result.worst_rad, std::abs(wrap(T_first_driver.heading_rad - T_first_wheels.heading_rad)));
  }
  return result;
}

void expect_agreement(std::span<const Sighting> sightings, double walk_m) {
  const Agreement found = agreement(sightings);
  EXPECT_GT(found.readings, 0U);
  // A whole unit in x and in y, and as much for the way the controller itself adds up.
  EXPECT_LE(found.worst_excess_m, 3.0 * kUnit_m + walk_m);
  EXPECT_LE(found.worst_rad, 1.01 * kHeadingUnit_rad);
}

}  // namespace azimuth::test
