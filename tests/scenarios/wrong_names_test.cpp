#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scenarios/replayed.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kWrongNamesSeeds = 20;

TEST(WrongNames, AStreakOfThemIsRecoveredFrom) {
  // GIVEN a sensor that reports each landmark under its neighbour's name for ten seconds of the second lap
  const auto confused = [](std::uint64_t seed) {
    auto run = simulated_run(lab(seed, 4));
    const auto landmarks = static_cast<Identity>(run.landmarks.size());
    for (BearingSet& set : run.bearings)
      if (to_seconds(set.stamp) > 100.0 && to_seconds(set.stamp) < 110.0)
        for (Bearing& bearing : set.bearings) bearing.identity = (bearing.identity + 1) % landmarks;
    return run;
  };
  // WHEN the names are correct again
  const Runs runs = replay_seeds(kWrongNamesSeeds, [&](std::uint64_t seed) { return replayed(confused(seed)); });
  runs.print("lab, ten seconds of wrong names");
  // THEN pose and map recover
  int recovered = 0;
  for (const Report& report : runs.reports)
    recovered += report.position_m.final < 0.2 && report.health == "tracking" && report.named_map.duplicates == 0 &&
                         report.named_map.position_m.mean < 0.2
                     ? 1
                     : 0;
  fmt::print("recovered: {} of {}\n", recovered, kWrongNamesSeeds);
  EXPECT_GE(recovered, kWrongNamesSeeds * 3 / 5);  // in the other runs the wrong names rebuild part of the map
}

TEST(WrongNames, AFewNowAndThenDoNoHarm) {
  // GIVEN one false detection under a landmark's name in every fifth image, from the first lap on
  const Runs runs = replay_seeds(kWrongNamesSeeds, [](std::uint64_t seed) {
    Scenario scenario = lab(seed);
    scenario.sensor.clutter_per_set = 0.2;
    return replayed(simulated_run(scenario));
  });
  runs.print("lab, false detections with names");
  EXPECT_EQ(runs.diverged(), 0);
  EXPECT_LE(runs.mean_m(), 0.1);
}

}  // namespace
}  // namespace azimuth
