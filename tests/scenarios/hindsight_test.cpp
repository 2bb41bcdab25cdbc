// Compares the smoother estimator with the EKF on the same drives with names, undisturbed and with typical disturbances
// of real drives.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

#include "tests/scenarios/replayed.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kSeeds = 4;
// Largest acceptable error relative to the EKF's.
constexpr double kNotWorse = 1.1, kRounding_m = 0.002;

struct Both {
  Runs filtered, smoothed;
};

Both both(const char* title, const std::function<Run(std::uint64_t seed)>& make) {
  Both both;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Run run = make(seed);
    both.filtered.reports.push_back(replayed(run));
    both.smoothed.reports.push_back(replayed_in_hindsight(run));
  }
  both.filtered.print(fmt::format("{}, ekf     ", title));
  both.smoothed.print(fmt::format("{}, smoother", title));
  return both;
}

void expect_not_worse(const Both& both) {
  EXPECT_EQ(both.smoothed.diverged(), 0);
  EXPECT_LE(both.smoothed.mean_m(), kNotWorse * both.filtered.mean_m() + kRounding_m);
  EXPECT_LE(both.smoothed.smoothed_m(), both.smoothed.mean_m());
  EXPECT_LE(both.smoothed.anees(), 6.0);
}

TEST(InHindsight, ADriveWithoutTroubleIsAsGood) {
  for (const auto& [name, make] : {std::pair{"lab", &lab}, std::pair{"hall", &hall}, std::pair{"corridor", &corridor},
                                   std::pair{"scattered", &scattered}, std::pair{"coloured-lab", &coloured_lab}}) {
    SCOPED_TRACE(name);
    const int laps = name == std::string("lab") ? 3 : 1;
    const auto scenario = make;
    expect_not_worse(both(name, [&](std::uint64_t seed) { return simulated_run(scenario(seed, laps)); }));
  }
}

TEST(InHindsight, OneNameInTwentyIsWrong) {
  expect_not_worse(both("5 % wrong names", [](std::uint64_t seed) {
    auto run = simulated_run(lab(seed));
    const auto landmarks = static_cast<Identity>(run.landmarks.size());
    std::size_t count = 0;
    for (BearingSet& set : run.bearings)
      for (Bearing& bearing : set.bearings)
        if (++count % 20 == 0) bearing.identity = (bearing.identity + static_cast<Identity>(seed)) % landmarks;
    return run;
  }));
}

TEST(InHindsight, TheFirstBearingOfEveryLandmarkHasAnothersName) {
  const Both runs = both("wrong from the start", [](std::uint64_t seed) {
    auto run = simulated_run(lab(seed));
    const auto landmarks = static_cast<Identity>(run.landmarks.size());
    for (BearingSet& set : run.bearings)
      if (to_seconds(set.stamp - run.bearings.front().stamp) < 0.3)
        for (Bearing& bearing : set.bearings) bearing.identity = (bearing.identity + 1) % landmarks;
    return run;
  });
  expect_not_worse(runs);
}

TEST(InHindsight, AThirdOfAllBearingsIsOfNothing) {
  expect_not_worse(both("a third clutter", [](std::uint64_t seed) {
    Scenario scenario = lab(seed);
    scenario.sensor.clutter_per_set = 4.0;
    return simulated_run(scenario);
  }));
}

TEST(InHindsight, SomeLandmarksWalkAbout) {
  // GIVEN 3 of 24 named landmarks that sway back and forth
  const Both runs = both("walking landmarks", [](std::uint64_t seed) {
    Scenario scenario = lab(seed);
    const auto run = simulated_run(scenario);
    auto moved = run;
    for (BearingSet& set : moved.bearings)
      for (Bearing& bearing : set.bearings)
        if (bearing.identity < 3)
          bearing.azimuth_rad = wrap(bearing.azimuth_rad + 0.6 * std::sin(0.2 * to_seconds(set.stamp)));
    return moved;
  });
  // THEN the harm is small, though larger than in the filter, which forgets old positions sooner
  EXPECT_EQ(runs.smoothed.diverged(), 0);
  EXPECT_LE(runs.smoothed.mean_m(), 1.4 * runs.filtered.mean_m());
  EXPECT_LE(runs.smoothed.anees(), 6.0);
}

/// From `when_s` on, odometry reports poses displaced by `apart`.
Run with_slip(Run run, double when_s, const Pose2& apart) {
  const Stamp when = run.odometry.front().stamp + duration_from_seconds(when_s);
  for (OdometryReading& reading : run.odometry)
    if (reading.stamp >= when) reading.T_odom_body = apart * reading.T_odom_body;
  return run;
}

TEST(InHindsight, WheelsSlipUnseen) {
  for (const auto& [title, apart] :
       {std::pair{"slip of 2 m", Pose2{2.0, 0.0, 0.0}}, std::pair{"turn of 30 degrees", Pose2{0.0, 0.0, 0.52}}}) {
    SCOPED_TRACE(title);
    const Pose2 by = apart;
    const Both runs =
        both(title, [&](std::uint64_t seed) { return with_slip(simulated_run(lab(seed, 3)), 120.0, by); });
    // THEN the robot relocalises on its map
    for (const Report& report : runs.smoothed.reports) {
      EXPECT_LT(report.position_m.final, 0.3) << report.health;
      EXPECT_EQ(report.health, "tracking");
    }
  }
}

TEST(InHindsight, MinutesWithoutImages) {
  expect_not_worse(both("two minutes dark", [](std::uint64_t seed) {
    auto run = simulated_run(lab(seed, 6));
    std::erase_if(run.bearings,
                  [](const BearingSet& set) { return to_seconds(set.stamp) > 150.0 && to_seconds(set.stamp) < 270.0; });
    return run;
  }));
}

}  // namespace
}  // namespace azimuth
