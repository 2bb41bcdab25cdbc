// Compares the default settings with the paper's printed settings on the paper's experiment (mathematics part IV,
// "coloured").

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scenarios/replayed.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kColouredSeeds = 50;

TEST(ColouredLab, DefaultSettingsNeverDivergeAndAreHonest) {
  // GIVEN 36 stops round a block in a lab with 24 coloured landmarks
  // WHEN they are replayed with the default settings
  const Runs runs =
      replay_seeds(kColouredSeeds, [](std::uint64_t seed) { return replayed(simulated_run(coloured_lab(seed))); });
  runs.print("coloured lab, default");

  // THEN no run diverges, the position errors agree with the noise, and the covariances are consistent
  EXPECT_EQ(runs.diverged(), 0);
  EXPECT_LE(runs.mean_m(), 0.15);
  EXPECT_GE(runs.anees(), 2.0);
  EXPECT_LE(runs.anees(), 5.0);
}

TEST(ColouredLab, PrintedSettingsFailFarMoreOften) {
  // GIVEN the same worlds
  const auto failed = [](const Report& report) {
    return !(report.position_m.max <= kDiverged_m) || !(report.consistency.anees <= 10.0);
  };
  const auto failures = [&](const Runs& runs) {
    return static_cast<int>(std::count_if(runs.reports.begin(), runs.reports.end(), failed));
  };
  // WHEN they are replayed with the paper's printed settings: a loose quality test and no gate
  const Runs paper = replay_seeds(kColouredSeeds, [](std::uint64_t seed) {
    const auto run = simulated_run(coloured_lab(seed));
    return replayed(run, paper_preset());
  });
  const Runs ours =
      replay_seeds(kColouredSeeds, [](std::uint64_t seed) { return replayed(simulated_run(coloured_lab(seed))); });
  paper.print("coloured lab, paper");
  fmt::print("diverged or inconsistent (ANEES above 10): paper {}, default {} of {}\n", failures(paper), failures(ours),
             kColouredSeeds);

  // THEN many runs diverge or become inconsistent, but very few with the default settings
  EXPECT_GE(failures(paper), kColouredSeeds / 4);
  EXPECT_LE(failures(ours), kColouredSeeds / 10);
  EXPECT_GT(paper.mean_m(), 2.0 * ours.mean_m());
}

}  // namespace
}  // namespace azimuth
