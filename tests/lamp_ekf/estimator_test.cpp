// What the lamp EKF does when things are not as in a hall where all goes well.

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kOneRound = 150;  // images

/// A run through an estimator that can be stopped anywhere.
struct Drive {
  explicit Drive(LampRun a_run, const LampEkfSettings& settings = {}) : run(std::move(a_run)), ekf(run.rig, settings) {}

  void to(std::size_t image) {
    for (; next < image; ++next) {
      ekf.predict(run.motions[next]);
      ekf.update(run.sets[next]);
    }
  }
  Estimate estimate() const {
    Estimate now;
    ekf.estimate(now);
    return now;
  }
  double error_m(std::size_t image) const {
    return (estimate().T_map_body.position() - (inverse(run.truth[0]) * run.truth[image]).position()).norm();
  }

  LampRun run;
  LampEkfEstimator ekf;
  std::size_t next = 0;
};

/// The map's lamps in the hall, each with the lamp nearest to it.
std::vector<int> lamps_mapped(const Drive& drive) {
  std::vector<int> mapped;
  for (const LandmarkEstimate& landmark : drive.estimate().landmarks) {
    const Eigen::Vector2d p = drive.run.truth[0] * landmark.p_map_landmark_m;
    const auto nearest = std::ranges::min_element(
        drive.run.lamps, {}, [&](const Eigen::Vector3d& lamp) { return (lamp.head<2>() - p).norm(); });
    EXPECT_LT((nearest->head<2>() - p).norm(), 1.0) << "clutter at " << p.transpose();
    mapped.push_back(static_cast<int>(nearest - drive.run.lamps.begin()));
  }
  std::ranges::sort(mapped);
  return mapped;
}

bool has_duplicates(const std::vector<int>& sorted) { return std::ranges::adjacent_find(sorted) != sorted.end(); }

TEST(LampEkfEstimator, TellsHeightsAndHowWellItKnowsThem) {
  Drive drive(simulated_hall(3));
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
  Drive drive(simulated_hall(3));
  drive.to(40);
  Estimate ahead;
  drive.ekf.look_ahead(drive.run.motions[40], ahead);
  drive.ekf.predict(drive.run.motions[40]);
  EXPECT_EQ(ahead.T_map_body, drive.estimate().T_map_body);
}

TEST(LampEkfEstimator, ExpectsLampsWhereTheyAreSeen) {
  Drive drive(simulated_hall(5));
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
  Drive drive(simulated_hall(7));
  drive.to(kOneRound);
  const std::size_t mapped = drive.estimate().landmarks.size();
  // For minutes the same image, in which some lamps are missed, with two reflections in it.
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
  Drive drive(simulated_hall(8));
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
  Drive drive(simulated_hall(9));
  drive.to(kOneRound);
  const std::vector<int> before = lamps_mapped(drive);
  // Carried across the hall and turned round: the ceiling is that of another place.
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
    Drive drive(simulated_hall(seed));
    Motion& slip = drive.run.motions[170];  // half a metre that the odometry knows nothing of
    slip.T_start_end = slip.T_start_end * Pose2{0.4, 0.2, 0.05};
    drive.to(drive.run.sets.size());
    const std::vector<int> mapped = lamps_mapped(drive);
    EXPECT_FALSE(has_duplicates(mapped)) << "seed " << seed;
    EXPECT_LT(drive.error_m(drive.run.sets.size() - 1), 0.5) << "seed " << seed;
  }
}

TEST(LampEkfEstimator, WhatIsInfinitelyHighIsNoLamp) {
  Drive drive(simulated_hall(15));
  for (std::size_t i = 0; i < drive.run.sets.size(); ++i)  // the sun through a roof window
    drive.run.sets[i].bearings.push_back(
        {.azimuth_rad = wrap(0.7 - drive.run.truth[i].heading_rad), .elevation_rad = 0.9});
  drive.to(drive.run.sets.size());
  EXPECT_EQ(lamps_mapped(drive).size(), drive.run.lamps.size());
  EXPECT_LT(drive.error_m(drive.run.sets.size() - 1), 0.5);
}

TEST(LampEkfEstimator, NamesAreKept) {
  Drive drive(simulated_hall(16));
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

/// Anywhere above the robot, never twice in the same place.
void add_reflections(BearingSet& image, int count, RandomDraws& draws) {
  for (int k = 0; k < count; ++k)
    image.bearings.push_back(
        {.azimuth_rad = draws.uniform(-kPi, kPi), .elevation_rad = std::asin(draws.uniform(0.4, 1.0))});
}

TEST(LampEkfEstimator, BeginsNoMapInACrowdAndSaysSo) {
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

TEST(LampEkfEstimator, HasOnlySoManyLampsOnProbationFromAllRound) {
  RandomDraws draws(2);
  LampEkfSettings settings;
  settings.max_on_probation = 12;
  LampEkfEstimator ekf(lamp_rig(), settings);
  BearingSet image;
  for (int k = 0; k < 36; ++k) image.bearings.push_back({.azimuth_rad = -3.1 + 0.17 * k, .elevation_rad = 0.8});
  ekf.update(image);
  ASSERT_EQ(ekf.lamps().size(), 12u);
  std::array<int, 4> begun{};  // by quarters of the horizon
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

TEST(LampEkfEstimator, RecognisesItsLampsInACrowdAndLosesNone) {
  Drive drive(simulated_hall(19));
  drive.to(kOneRound);
  const std::vector<int> before = lamps_mapped(drive);
  RandomDraws draws(3);
  for (std::size_t i = kOneRound; i < 200; ++i) add_reflections(drive.run.sets[i], 400, draws);
  drive.to(200);
  EXPECT_EQ(lamps_mapped(drive), before);
  EXPECT_EQ(drive.estimate().health, Health::tracking) << drive.estimate().reason;
  EXPECT_LT(drive.error_m(199), 0.3);
}

TEST(LampEkfEstimator, DoesNotAllocateOnceTheMapStandsStill) {
  Drive drive(simulated_hall(17));
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
  Drive a(simulated_hall(18)), b(simulated_hall(18));
  a.to(200);
  b.to(200);
  EXPECT_EQ(a.estimate().T_map_body, b.estimate().T_map_body);
  EXPECT_EQ(a.estimate().pose_covariance, b.estimate().pose_covariance);
}

}  // namespace
}  // namespace azimuth
