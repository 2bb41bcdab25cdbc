// The lamp EKF in front of far more lights than there are lamps.

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/geometry/random_draws.hpp"
#include "tests/lamp_ekf/lamp_drive.hpp"

namespace azimuth {
namespace {

/// Adds reflections at random directions above the robot, new ones in each call.
void add_reflections(BearingSet& image, int count, RandomDraws& draws) {
  for (int k = 0; k < count; ++k)
    image.bearings.push_back(
        {.azimuth_rad = draws.uniform(-kPi, kPi), .elevation_rad = std::asin(draws.uniform(0.4, 1.0))});
}

TEST(LampEkfCrowd, BeginsNoMapInACrowdAndSaysSo) {
  RandomDraws draws(1);
  LampEkfEstimator ekf(lamp_rig(), {});
  BearingSet crowd;
  add_reflections(crowd, LampEkfSettings{}.max_directions + 1, draws);
  ekf.update(crowd);
  EXPECT_TRUE(ekf.lamps().empty());
  Estimate now;
  ekf.estimate(now);
  EXPECT_EQ(now.health, Health::starting);
  EXPECT_EQ(now.reason, "too many lights to begin a map with");
  crowd.bearings.resize(20);
  ekf.update(crowd);
  EXPECT_EQ(ekf.lamps().size(), 20u);
}

TEST(LampEkfCrowd, HasOnlySoManyLampsOnProbationFromAllRound) {
  RandomDraws draws(2);
  LampEkfSettings settings;
  settings.probation.most = 12;
  LampEkfEstimator ekf(lamp_rig(), settings);
  BearingSet image;
  for (int k = 0; k < 36; ++k) image.bearings.push_back({.azimuth_rad = -3.1 + 0.17 * k, .elevation_rad = 0.8});
  ekf.update(image);
  ASSERT_EQ(ekf.lamps().size(), 12u);
  std::array<int, 4> begun{};  // new lamps by quarters of the horizon
  for (const Lamp& lamp : ekf.lamps()) {
    const Eigen::Vector3d p = ekf.filter().point(lamp.at).p_map_lamp_m;
    ++begun[static_cast<std::size_t>((std::atan2(p.y(), p.x()) + kPi) / (kPi / 2.0))];
  }
  EXPECT_EQ(begun, (std::array<int, 4>{3, 3, 3, 3}));
  for (int i = 0; i < 5; ++i) {
    add_reflections(image, 10, draws);
    ekf.update(image);
    EXPECT_EQ(ekf.lamps().size(), 12u);
  }
}

TEST(LampEkfCrowd, RecognisesItsLampsInACrowdAndLosesNone) {
  LampDrive drive(simulated_hall(19));
  drive.to(kOneRound);
  const std::vector<int> before = lamps_mapped(drive);
  RandomDraws draws(3);
  for (std::size_t i = kOneRound; i < 200; ++i) add_reflections(drive.run.sets[i], 400, draws);
  drive.to(200);
  EXPECT_EQ(lamps_mapped(drive), before);
  EXPECT_EQ(drive.estimate().health, Health::tracking) << drive.estimate().reason;
  EXPECT_LT(drive.error_m(199), 0.3);
}
}  // namespace
}  // namespace azimuth
