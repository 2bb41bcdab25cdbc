// The lamp EKF in halls with lamps that all look alike: the second paper's experiment (mathematics II.10, part IV).

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

#include "tests/support/data.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

constexpr int kRecordedSeeds = 10;

/// The number of seeds, from the environment variable AZIMUTH_LAMP_SEEDS. A hundred seeds take a few seconds.
int seeds() {
  const char* wanted = std::getenv("AZIMUTH_LAMP_SEEDS");
  return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 12;
}

struct Summary {
  int runs = 0, closed = 0;
  double position_mean_m = 0.0, position_worst_mean_m = 0.0, position_max_m = 0.0, anees = 0.0;
  double lamp_mean_m = 0.0, lamp_max_m = 0.0, landmarks = 0.0;
  std::size_t fewest_lamps = 1000, most_landmarks = 0;
};

Summary summarise(const char* title, int runs, const std::function<LampRun(int)>& make) {
  Summary summary;
  summary.runs = runs;
  for (int seed = 0; seed < runs; ++seed) {
    const LampOutcome outcome = drive(make(seed), LampEkfSettings{});
    if (std::getenv("AZIMUTH_VERBOSE") != nullptr)
      fmt::print(
          "seed {:>3}: position {:.3f} max {:.3f} anees {:.2f} closed {} ({} right, {} wrong) {} landmarks, {} lamps, "
          "{:.3f}\n",
          seed, outcome.position_mean_m, outcome.position_max_m, outcome.anees, outcome.closed(), outcome.right,
          outcome.wrong, outcome.landmarks, outcome.lamp_errors_m.size(), outcome.lamp_mean_m());
    summary.closed += outcome.closed() ? 1 : 0;
    summary.position_mean_m += outcome.position_mean_m / runs;
    summary.position_worst_mean_m = std::max(summary.position_worst_mean_m, outcome.position_mean_m);
    summary.position_max_m = std::max(summary.position_max_m, outcome.position_max_m);
    summary.anees += outcome.anees / runs;
    summary.lamp_mean_m += outcome.lamp_mean_m() / runs;
    if (!outcome.lamp_errors_m.empty())
      summary.lamp_max_m = std::max(summary.lamp_max_m, *std::ranges::max_element(outcome.lamp_errors_m));
    summary.landmarks += static_cast<double>(outcome.landmarks) / runs;
    summary.fewest_lamps = std::min(summary.fewest_lamps, outcome.lamp_errors_m.size());
    summary.most_landmarks = std::max(summary.most_landmarks, outcome.landmarks);
  }
  fmt::print(
      "{:<10} closed {} of {}, position {:.3f} m (worst run {:.3f}, worst moment {:.2f}), ANEES {:.2f}, lamps {:.3f} m "
      "(worst {:.2f}), {:.1f} mapped, at most {}\n",
      title, summary.closed, runs, summary.position_mean_m, summary.position_worst_mean_m, summary.position_max_m,
      summary.anees, summary.lamp_mean_m, summary.lamp_max_m, summary.landmarks, summary.most_landmarks);
  return summary;
}

TEST(LampEkfHall, ClosesEveryLoopInSimulatedHalls) {
  const Summary outcome =
      summarise("simulated", seeds(), [](int seed) { return simulated_hall(static_cast<std::uint64_t>(seed + 1)); });
  EXPECT_GE(outcome.closed, 0.95 * outcome.runs);
  EXPECT_LE(outcome.position_mean_m, 0.10);
  EXPECT_GT(outcome.anees, 0.8);  // the rig gives no calibration errors, so the filter assumes typical ones
  EXPECT_LT(outcome.anees, 4.0);
}

TEST(LampEkfHall, ClosesEveryLoopInHallRuns) {
  AZIMUTH_REQUIRE_DATA("hall-runs");
  const Summary outcome = summarise("hall-runs", kRecordedSeeds, [](int seed) {
    return recorded_hall(test::data_folder() / "hall-runs" / fmt::format("hall-{:03}", seed));
  });
  EXPECT_EQ(outcome.closed, outcome.runs);
  EXPECT_LE(outcome.position_mean_m, 0.10);
}

}  // namespace
}  // namespace azimuth
