#include "tests/robot/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace azimuth::test {

Pose2 error_since(const Sighting& first, const Sighting& later) {
  const Pose2 wheels = inverse(first.T_odom_wheels) * later.T_odom_wheels;
  const Pose2 driver = inverse(first.reading.T_odom_body) * later.reading.T_odom_body;
  return {driver.x_m - wheels.x_m, driver.y_m - wheels.y_m, wrap(driver.heading_rad - wheels.heading_rad)};
}

Agreement agreement(std::span<const Sighting> sightings) {
  Agreement result;
  const Sighting* first = nullptr;
  for (const Sighting& sighting : sightings) {
    ++result.readings;
    if (first == nullptr || sighting.reading.origin != first->reading.origin) {
      first = &sighting;
      ++result.origins;
    }
    const Pose2 error = error_since(*first, sighting);
    const double error_m = error.position().norm();
    const double explained_m =
        kHeadingUnit_rad * (inverse(first->T_odom_wheels) * sighting.T_odom_wheels).position().norm();
    result.worst_m = std::max(result.worst_m, error_m);
    result.worst_excess_m = std::max(result.worst_excess_m, error_m - explained_m);
    result.worst_rad = std::max(result.worst_rad, std::abs(error.heading_rad));
  }
  return result;
}

void expect_agreement(std::span<const Sighting> sightings, double walk_m) {
  const Agreement found = agreement(sightings);
  EXPECT_GT(found.readings, 0U);
  // One unit in x and in y, and as much again for rounding in the controller's own integration.
  EXPECT_LE(found.worst_excess_m, 3.0 * kUnit_m + walk_m);
  EXPECT_LE(found.worst_rad, 1.05 * kHeadingUnit_rad);
}

}  // namespace azimuth::test
