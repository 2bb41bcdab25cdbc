// The lamp EKF in disturbed situations.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/geometry/random_draws.hpp"
#include "tests/lamp_ekf/lamp_drive.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

bool has_duplicates(const std::vector<int>& sorted) { return std::ranges::adjacent_find(sorted) != sorted.end(); }

TEST(LampEkfEstimator, TellsHeightsAndHowWellItKnowsThem) {
  LampDrive drive(simulated_hall(3));
  EXPECT_EQ(drive.estimate().health, Health::starting);
  drive.to(kOneRound);
  const Estimate now = drive.estimate();
  EXPECT_EQ(now.health, Health::tracking) << now.reason;
  ASSERT_FALSE(now.landmarks.empty());
  for (const LandmarkEstimate& landmark : now.landmarks) {
    EXPECT_GT(landmark.sigma_z_m, 0.0);
    EXPECT_LT(std::abs(landmark.z_map_landmark_m - 6.5), 4.0 * landmark.sigma_z_m + 0.01);
  }
  EXPECT_FALSE(now.accepted.empty());
  for (const AcceptedSighting& seen : now.accepted)
    EXPECT_EQ(std::ranges::count(now.landmarks, seen.landmark_id, &LandmarkEstimate::id), 1);
}

TEST(LampEkfEstimator, LooksAheadAsItWouldPredict) {
  LampDrive drive(simulated_hall(3));
  drive.to(40);
  Estimate ahead;
  drive.ekf.look_ahead(drive.run.motions[40], ahead);
  drive.ekf.predict(drive.run.motions[40]);
  EXPECT_EQ(ahead.T_map_body, drive.estimate().T_map_body);
}

TEST(LampEkfEstimator, ExpectsLampsWhereTheyAreSeen) {
  LampDrive drive(simulated_hall(5));
  drive.to(kOneRound);
  std::vector<ExpectedBearing> expected;
  drive.ekf.predict(drive.run.motions[kOneRound]);
  drive.ekf.expect(expected);
  ASSERT_FALSE(expected.empty());
  drive.ekf.update(drive.run.sets[kOneRound]);
  const auto lamps = drive.ekf.lamps_of_bearings();
  std::size_t checked = 0;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (lamps[i] == LampEkfEstimator::kNoLamp) continue;
    const auto found = std::ranges::find(expected, lamps[i], &ExpectedBearing::landmark);
    ASSERT_NE(found, expected.end());
    EXPECT_LT(std::abs(wrap(found->azimuth_rad - drive.run.sets[kOneRound].bearings[i].azimuth_rad)), found->gate_rad);
    ++checked;
  }
  EXPECT_GT(checked, 3u);
}

TEST(LampEkfEstimator, AStandingRobotForgetsAndConfirmsNothing) {
  LampDrive drive(simulated_hall(7));
  drive.to(kOneRound);
  const std::size_t mapped = drive.estimate().landmarks.size();
  // The same image for minutes. It misses some lamps and contains two reflections.
  BearingSet image = drive.run.sets[kOneRound - 1];
  image.bearings.resize(image.bearings.size() - 2);
  for (const double azimuth_rad : {0.3, 2.4})
    image.bearings.push_back({.azimuth_rad = azimuth_rad, .elevation_rad = 1.2});
  for (int i = 0; i < 300; ++i) {
    drive.ekf.predict({});
    drive.ekf.update(image);
  }
  EXPECT_EQ(drive.estimate().landmarks.size(), mapped);
  drive.next = kOneRound;
  drive.to(drive.run.sets.size());
  EXPECT_LT(drive.error_m(drive.run.sets.size() - 1), 0.5);
}

TEST(LampEkfEstimator, ALampSwitchedOffIsTakenOutAndTheOthersStay) {
  LampDrive drive(simulated_hall(8));
  for (std::size_t i = kOneRound; i < drive.run.sets.size(); ++i) {
    auto& bearings = drive.run.sets[i].bearings;
    auto& lamp_of = drive.run.lamp_of[i];
    for (std::size_t l = bearings.size(); l-- > 0;) {
      if (lamp_of[l] != 6) continue;
      bearings.erase(bearings.begin() + static_cast<std::ptrdiff_t>(l));
      lamp_of.erase(lamp_of.begin() + static_cast<std::ptrdiff_t>(l));
    }
  }
  drive.to(kOneRound);
  EXPECT_TRUE(std::ranges::count(lamps_mapped(drive), 6) == 1);
  drive.to(drive.run.sets.size());
  const std::vector<int> mapped = lamps_mapped(drive);
  EXPECT_EQ(std::ranges::count(mapped, 6), 0);
  EXPECT_EQ(mapped.size(), drive.run.lamps.size() - 1);
  EXPECT_FALSE(has_duplicates(mapped));
}

TEST(LampEkfEstimator, AKidnappedRobotSpoilsNoMapAndSaysSo) {
  LampDrive drive(simulated_hall(9));
  drive.to(kOneRound);
  const std::vector<int> before = lamps_mapped(drive);
  // The robot is carried across the hall and turned, so that it sees the ceiling of another place.
  std::vector<BearingSet> there;
  bool said = false;
  for (std::size_t i = 0; i < 40; ++i) {
    BearingSet image = drive.run.sets[kOneRound + 60 + i];
    for (Bearing& bearing : image.bearings) bearing.azimuth_rad = wrap(bearing.azimuth_rad + 0.9);
    drive.ekf.predict(drive.run.motions[kOneRound + i]);
    drive.ekf.update(image);
    const Health health = drive.estimate().health;
    said = said || health == Health::lost;
    if (i >= 8) continue;
    EXPECT_EQ(lamps_mapped(drive), before) << i;
  }
  EXPECT_TRUE(said);
}

TEST(LampEkfEstimator, ASlipOfTheWheelsLeavesNoLampMappedTwice) {
  for (const std::uint64_t seed : {1u, 6u, 12u, 23u}) {
    LampDrive drive(simulated_hall(seed));
    Motion& slip = drive.run.motions[170];  // a slip of half a metre that odometry does not measure
    slip.T_start_end = slip.T_start_end * Pose2{0.4, 0.2, 0.05};
    drive.to(drive.run.sets.size());
    const std::vector<int> mapped = lamps_mapped(drive);
    EXPECT_FALSE(has_duplicates(mapped)) << "seed " << seed;
    EXPECT_LT(drive.error_m(drive.run.sets.size() - 1), 0.5) << "seed " << seed;
  }
}

TEST(LampEkfEstimator, WhatIsInfinitelyHighIsNoLamp) {
  LampDrive drive(simulated_hall(15));
  for (std::size_t i = 0; i < drive.run.sets.size(); ++i)  // the sun through a roof window
    drive.run.sets[i].bearings.push_back(
        {.azimuth_rad = wrap(0.7 - drive.run.truth[i].heading_rad), .elevation_rad = 0.9});
  drive.to(drive.run.sets.size());
  EXPECT_EQ(lamps_mapped(drive).size(), drive.run.lamps.size());
  EXPECT_LT(drive.error_m(drive.run.sets.size() - 1), 0.5);
}

TEST(LampEkfEstimator, NamesAreKept) {
  LampDrive drive(simulated_hall(16));
  for (std::size_t i = 0; i < drive.run.sets.size(); ++i)
    for (std::size_t l = 0; l < drive.run.sets[i].bearings.size(); ++l)
      drive.run.sets[i].bearings[l].identity =
          drive.run.lamp_of[i][l] == LampRun::kClutter ? kUnknownIdentity : 100 + drive.run.lamp_of[i][l];
  drive.to(drive.run.sets.size());
  const Estimate last = drive.estimate();
  EXPECT_EQ(last.landmarks.size(), drive.run.lamps.size());
  for (const LandmarkEstimate& landmark : last.landmarks) EXPECT_GE(landmark.identity, 100);
}

TEST(LampEkfEstimator, SaysThatBearingsBringNoElevation) {
  LampEkfEstimator ekf(lamp_rig(), {});
  BearingSet image;
  image.bearings.push_back({.azimuth_rad = 0.2});
  ekf.update(image);
  Estimate now;
  ekf.estimate(now);
  EXPECT_EQ(now.health, Health::starting);
  EXPECT_EQ(now.reason, "bearings bring no elevation");
}

TEST(LampEkfEstimator, SurvivesDirectionsThatNoLampHas) {
  LampEkfEstimator ekf(lamp_rig(), {});
  BearingSet image;
  for (const double elevation_rad : {-1.5, 0.0, 1e-9, kPi / 2.0, kPi / 2.0 - 1e-12})
    for (int i = 0; i < 30; ++i)
      image.bearings.push_back({.azimuth_rad = 0.2 * i - 3.0, .elevation_rad = elevation_rad});
  Motion motion;
  motion.T_start_end = {0.1, 0.0, 0.1};
  motion.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  motion.path_m = 0.1;
  Estimate now;
  for (int i = 0; i < 10; ++i) {
    ekf.predict(motion);
    ekf.update(image);
    now.landmarks.clear();
    ekf.estimate(now);
    ASSERT_TRUE(now.T_map_body.vector().allFinite());
    ASSERT_TRUE(now.pose_covariance.allFinite());
    for (const LandmarkEstimate& landmark : now.landmarks) ASSERT_TRUE(landmark.p_map_landmark_m.allFinite());
  }
}

TEST(LampEkfEstimator, DoesNotAllocateOnceTheMapStandsStill) {
  LampDrive drive(simulated_hall(17));
  drive.to(200);
  Estimate now;
  now.landmarks.reserve(64);
  now.accepted.reserve(64);
  const std::size_t before = allocations();
  drive.to(300);
  drive.ekf.estimate(now);
  EXPECT_EQ(allocations(), before);
}

TEST(LampEkfEstimator, IsTheSameToTheLastBit) {
  LampDrive a(simulated_hall(18)), b(simulated_hall(18));
  a.to(200);
  b.to(200);
  EXPECT_EQ(a.estimate().T_map_body, b.estimate().T_map_body);
  EXPECT_EQ(a.estimate().pose_covariance, b.estimate().pose_covariance);
}

}  // namespace
}  // namespace azimuth
