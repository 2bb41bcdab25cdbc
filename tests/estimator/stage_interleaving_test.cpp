// The order of arrival must not change the estimates. As long as every reading stamped before a set arrives no later
// than the set, the estimates are the same to the last bit.

#include <gtest/gtest.h>
#include <optional>

#include "slam/estimator/estimate_digest.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

/// A lap with the defects of a real recording: a pause of the odometer, a pause of the camera, and lost samples.
World damaged_lap(const Scenario& scenario) {
  World world = simulate(scenario);
  const auto within = [](Stamp stamp, double from_s, double to_s) {
    return to_seconds(stamp) > from_s && to_seconds(stamp) < to_s;
  };
  std::erase_if(world.odometry, [&](const OdometryReading& reading) {
    return within(reading.stamp, 20.0, 22.0) || reading.sequence % 37 == 5;
  });
  std::erase_if(world.bearings,
                [&](const BearingSet& set) { return within(set.stamp, 40.0, 43.0) || set.sequence % 29 == 3; });
  return world;
}

/// How samples arrive, and how often the estimator's thread runs.
struct Arrival {
  double odometry_first = 0.5;  ///< Chance that the next sample is a reading, where the contract leaves a choice
  double advance = 0.5;         ///< Chance to advance after an arrival
  double look_ahead = 0.0;      ///< Chance to ask for a prediction
};

class Interleaving {
 public:
  Interleaving(const World& world, const Rig& rig)
      : world_(world), rig_(rig), stage_(std::make_unique<EkfEstimator>(rig, EkfSettings{}), rig, StageSettings{}) {}

  std::uint64_t digest(const Arrival& arrival, unsigned seed) {
    RandomDraws draws(seed);
    while (readings_ < world_.odometry.size() || sets_ < world_.bearings.size()) {
      deliver(draws.chance(arrival.odometry_first));
      if (draws.chance(arrival.look_ahead)) stage_.look_ahead(prediction_);
      if (draws.chance(arrival.advance)) advance();
    }
    stage_.finish();
    advance();
    return digest_.value();
  }
  std::uint64_t estimates() const { return digest_.estimates(); }

 private:
  void deliver(bool odometry_first) {
    const bool readings_left = readings_ < world_.odometry.size(), sets_left = sets_ < world_.bearings.size();
    // The stage's storage is bounded, so neither kind of sample may run ahead of the other by more than the stage
    // keeps.
    constexpr Duration kAhead = std::chrono::seconds(20);
    bool reading = readings_left && (odometry_first || !sets_left);
    if (readings_left && sets_left) {
      const Stamp next_reading = world_.odometry[readings_].stamp, next_set = world_.bearings[sets_].stamp;
      if (next_reading < next_set) reading = true;  // required by the contract
      if (next_reading > next_set + kAhead) reading = false;
    }
    if (reading) {
      stage_.add(world_.odometry[readings_++]);
    } else {
      BearingSet set = world_.bearings[sets_++];
      stage_.add(set);
    }
  }

  void advance() {
    while (stage_.advance(estimate_)) digest_.add(estimate_);
  }

  const World& world_;
  Rig rig_;
  EstimatorStage stage_;
  EstimateDigest digest_;
  Estimate estimate_, prediction_;
  std::size_t readings_ = 0, sets_ = 0;
};

class SameBits : public testing::TestWithParam<double> {
 protected:
  SameBits() {
    Scenario scenario = lab(4, 1);
    scenario.odometer.lag_s = GetParam();
    world_ = damaged_lap(scenario);
    rig_ = rig_of(scenario);
    Interleaving in_order(world_, rig_);
    expected_ = in_order.digest({0.0, 1.0, 0.0}, 1);
    estimates_ = in_order.estimates();
  }
  void expect_same(const Arrival& arrival, unsigned seed) const {
    SCOPED_TRACE(seed);
    Interleaving interleaving(world_, rig_);
    EXPECT_EQ(interleaving.digest(arrival, seed), expected_);
    EXPECT_EQ(interleaving.estimates(), estimates_);
  }

  World world_;
  Rig rig_;
  std::uint64_t expected_ = 0, estimates_ = 0;
};

TEST_P(SameBits, WhateverTheArrival) {
  EXPECT_GT(estimates_, 250u);
  EXPECT_LT(estimates_, world_.bearings.size());  // some sets had no odometry
  RandomDraws draws(51);
  for (unsigned seed = 2; seed < 14; ++seed)
    expect_same({draws.uniform(0.0, 1.0), draws.uniform(0.01, 1.0), 0.0}, seed);
}

TEST_P(SameBits, WhenOdometryRunsFarAhead) { expect_same({1.0, 0.3, 0.0}, 61); }

TEST_P(SameBits, WhetherOrNotPredictionsAreAskedFor) {
  for (unsigned seed = 71; seed < 74; ++seed) expect_same({0.5, 0.5, 0.7}, seed);
}

/// Feeds a stage whose odometry is held up for up to 3 s now and then, as on a serial line, while bearings continue to
/// come. Returns the samples that the stage accepted.
World arrive_late(const World& world, const Rig& rig, unsigned seed, EstimateDigest& digest) {
  EstimatorStage stage(std::make_unique<EkfEstimator>(rig, EkfSettings{}), rig, StageSettings{});
  RandomDraws draws(seed);
  World taken;
  Estimate estimate;
  std::size_t next = 0;
  Stamp held_until = world.bearings.front().stamp;
  for (const BearingSet& set : world.bearings) {
    if (draws.chance(0.05)) held_until = set.stamp + duration_from_seconds(draws.uniform(0.0, 3.0));
    const Duration late = duration_from_seconds(draws.uniform(0.0, 0.05));
    const bool held = set.stamp < held_until;
    for (; !held && next < world.odometry.size() && world.odometry[next].stamp + late <= set.stamp; ++next)
      if (stage.add(world.odometry[next])) taken.odometry.push_back(world.odometry[next]);
    taken.bearings.push_back(set);
    BearingSet given = set;
    stage.add(given);
    while (stage.advance(estimate)) digest.add(estimate);
  }
  stage.finish();
  while (stage.advance(estimate)) digest.add(estimate);
  return taken;
}

TEST_P(SameBits, WhenWhatWasTakenOfLateReadingsIsPlayedInOrder) {
  for (unsigned seed = 81; seed < 87; ++seed) {
    EstimateDigest live;
    const World taken = arrive_late(world_, rig_, seed, live);
    EXPECT_LT(taken.odometry.size(), world_.odometry.size()) << "some must have been too late";
    Interleaving in_order(taken, rig_);
    EXPECT_EQ(in_order.digest({0.0, 1.0, 0.0}, 1), live.value()) << seed;
    EXPECT_GT(live.estimates(), estimates_ / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Lag, SameBits, testing::Values(0.0, 0.2, -0.15), [](const auto& instance) {
  return instance.param == 0.0 ? "None" : instance.param > 0.0 ? "Late" : "Early";
});

}  // namespace
}  // namespace azimuth
