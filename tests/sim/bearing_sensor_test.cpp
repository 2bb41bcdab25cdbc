#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "sim/world/sensors.hpp"

namespace azimuth {
namespace {

const std::vector<WorldLandmark> kLandmarks{{0, {2.0, 0.0}}, {1, {0.0, 3.0}}, {2, {-4.0, 0.0}}, {3, {0.0, -5.0}}};

BearingSensorSettings perfect() {
  BearingSensorSettings settings;
  settings.sigma_bearing_rad = 0.0;
  return settings;
}

std::vector<Identity> identities(const BearingSet& set) {
  std::vector<Identity> seen;
  for (const Bearing& bearing : set.bearings) seen.push_back(bearing.identity);
  std::sort(seen.begin(), seen.end());
  return seen;
}

TEST(BearingSensor, MeasuresCounterClockwiseFromTheHeading) {
  Random random(1, RandomPurpose::bearings);
  const BearingSet set = observe(kLandmarks, {0.0, 0.0, kPi / 2}, perfect(), random);
  ASSERT_EQ(set.bearings.size(), 4u);
  for (const Bearing& bearing : set.bearings) {
    const Eigen::Vector2d p = kLandmarks[static_cast<std::size_t>(bearing.identity)].p_world_landmark_m;
    EXPECT_NEAR(wrap(bearing.azimuth_rad - (std::atan2(p.y(), p.x()) - kPi / 2)), 0.0, 1e-12);
    EXPECT_TRUE(std::isnan(bearing.elevation_rad));
  }
  EXPECT_TRUE(std::is_sorted(set.bearings.begin(), set.bearings.end(),
                             [](const Bearing& a, const Bearing& b) { return a.azimuth_rad < b.azimuth_rad; }));
}

TEST(BearingSensor, SeesWithinRangeAndFieldOfView) {
  Random random(1, RandomPurpose::bearings);
  BearingSensorSettings settings = perfect();
  settings.max_range_m = 4.5;
  EXPECT_EQ(identities(observe(kLandmarks, {}, settings, random)), (std::vector<Identity>{0, 1, 2}));
  settings.min_range_m = 2.5;
  EXPECT_EQ(identities(observe(kLandmarks, {}, settings, random)), (std::vector<Identity>{1, 2}));
  settings.field_of_view_rad = 1.01 * kPi;
  EXPECT_EQ(identities(observe(kLandmarks, {}, settings, random)), (std::vector<Identity>{1}));
  settings.yaw_offset_rad = kPi;  // looks backwards
  EXPECT_EQ(identities(observe(kLandmarks, {}, settings, random)), (std::vector<Identity>{1, 2}));
}

TEST(BearingSensor, ReportsAnglesFromTheCamerasOwnZero) {
  Random random(1, RandomPurpose::bearings);
  BearingSensorSettings settings = perfect();
  settings.yaw_offset_rad = 0.1;
  const BearingSet set = observe({kLandmarks[0]}, {}, settings, random);
  ASSERT_EQ(set.bearings.size(), 1u);
  EXPECT_NEAR(set.bearings[0].azimuth_rad, -0.1, 1e-12);
}

TEST(BearingSensor, NoiseAndDetectionHaveTheirStatistics) {
  Random random(2, RandomPurpose::bearings);
  BearingSensorSettings settings;
  settings.sigma_bearing_rad = 0.03;
  settings.detection_probability = 0.8;
  constexpr int kSets = 40000;
  int seen = 0;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kSets; ++i)
    for (const Bearing& bearing : observe({kLandmarks[0]}, {}, settings, random).bearings) {
      ++seen;
      sum += bearing.azimuth_rad;
      squares += bearing.azimuth_rad * bearing.azimuth_rad;
    }
  EXPECT_NEAR(seen / double{kSets}, 0.8, 0.01);
  EXPECT_NEAR(sum / seen, 0.0, 5e-4);
  EXPECT_NEAR(std::sqrt(squares / seen), 0.03, 5e-4);
}

TEST(BearingSensor, ClutterCarriesTheNameOfALandmarkNotSeen) {
  Random random(3, RandomPurpose::bearings);
  BearingSensorSettings settings = perfect();
  settings.max_range_m = 3.5;  // landmarks 0 and 1 are within range
  settings.clutter_per_set = 0.5;
  int clutter = 0;
  for (int i = 0; i < 10000; ++i) {
    const std::vector<Identity> seen = identities(observe(kLandmarks, {}, settings, random));
    ASSERT_GE(seen.size(), 2u);
    clutter += static_cast<int>(seen.size()) - 2;
    std::set<Identity> named(seen.begin(), seen.end());
    const auto unnamed = std::count(seen.begin(), seen.end(), kUnknownIdentity);
    ASSERT_EQ(named.size() - named.count(kUnknownIdentity), seen.size() - static_cast<std::size_t>(unnamed));
  }
  EXPECT_NEAR(clutter / 10000.0, 0.5, 0.03);
}

TEST(BearingSensor, HidesIdentities) {
  Random random(4, RandomPurpose::bearings);
  BearingSensorSettings settings;
  settings.identities = false;
  settings.clutter_per_set = 2.0;
  for (const Bearing& bearing : observe(kLandmarks, {}, settings, random).bearings)
    EXPECT_EQ(bearing.identity, kUnknownIdentity);
}

}  // namespace
}  // namespace azimuth
