// Landmarks all alike in worlds drawn at random: what is said of the error holds.

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "tests/support/random_world.hpp"
#include "tests/support/world_score.hpp"

namespace azimuth {
namespace {

TEST(RandomWorld, IsTheSameForTheSameSeed) {
  const auto one = run_through(random_world(3)), again = run_through(random_world(3)),
             other = run_through(random_world(5));
  EXPECT_EQ(one.odometry, again.odometry);
  EXPECT_EQ(one.rig_toml, again.rig_toml);
  EXPECT_NE(one.odometry, other.odometry);
  EXPECT_NE(one.rig_toml, other.rig_toml);
}

TEST(RandomWorld, HasAsMuchOfNothingAsItSays) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const RandomWorld world = random_world(seed);
    Scenario clean = world.scenario;
    clean.sensor.clutter_per_set = 0.0;
    const auto bearings = [](const std::vector<BearingSet>& sets) {
      double count = 0.0;
      for (const BearingSet& set : sets) count += static_cast<double>(set.bearings.size());
      return count;
    };
    const double all = bearings(simulate(world.scenario).bearings), good = bearings(simulate(clean).bearings);
    EXPECT_NEAR(1.0 - good / all, world.clutter_share, 0.04);
  }
}

TEST(RandomWorld, ItsRigTakesTheOdometersScalesForRight) {
  const RandomWorld world = random_world(1);
  const auto run = run_through(world);
  EXPECT_NE(world.scenario.odometer.scale_distance, 1.0);
  EXPECT_NE(run.rig_toml.find("scale_distance = 1.0\n"), std::string::npos);
  EXPECT_NE(run.rig_toml.find("scale_turn = 1.0\n"), std::string::npos);
}

TEST(RandomWorlds, ErrorsAreWithinWhatIsSaidOfThem) {
  constexpr std::uint64_t kWorlds = 12;
  Configuration configuration;
  configuration.estimator = "smoother";
  std::vector<WorldScore> worlds;
  double live_m = 0.0, odometry_m = 0.0, tracking = 0.0;
  for (std::uint64_t seed = 1; seed <= kWorlds; ++seed) {
    const Report& report =
        worlds.emplace_back(score_without_names(run_through(random_world(seed)), configuration)).report;
    live_m += report.position_m.rmse / kWorlds;
    odometry_m += report.odometry_m.rmse / kWorlds;
    tracking += report.health_over_time.of(Health::tracking).share / kWorlds;
    // Of none it is no number, which is not above anything.
    EXPECT_FALSE(report.tracking_consistency.anees > 6.0) << report.run;
  }
  const double within = share_within(two_sigma_shares(worlds, SigmaMeasure::ellipse, false));
  const double within_tracking = share_within(two_sigma_shares(worlds, SigmaMeasure::ellipse, true));
  fmt::print(
      "odometry {:.3f} m, live {:.3f} m, within the 95 % ellipse {:.3f}, while tracking {:.3f}, which is {:.2f}\n",
      odometry_m, live_m, within, within_tracking, tracking);
  EXPECT_LE(live_m, odometry_m);
  EXPECT_GE(within, 0.95);
  EXPECT_GE(within_tracking, 0.95);
}

}  // namespace
}  // namespace azimuth
