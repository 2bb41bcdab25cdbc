// Runs without identities: the accuracy that must be reached, live and in hindsight, and the consistency of the
// covariances.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "tests/support/data.hpp"
#include "tests/support/hidden_lab.hpp"
#include "tests/support/nameless_run.hpp"

namespace azimuth {
namespace {

/// Means over the runs, except for the counts.
struct LabScore {
  RunError online, smoothed;
  double odometry_m = 0.0, mapped = 0.0, duplicates = 0.0, trusted = 0.0, worst_trusted_anees = 0.0;
  int worse_than_odometry = 0, trusted_in_vain = 0;
};

void add(const Run& run, double share, LabScore& score) {
  const Rig rig = *read_rig(run.rig_toml, run.rig_file);
  InTurn workers;
  NamelessMapScore map;
  const NamelessRun result = nameless_run(run, rig, nameless_settings_for(rig), workers, map);
  const RunError online = run_error(run, result.online), smoothed = run_error(run, result.smoothed);
  const double odometry_m = run_error(run, result.odometry).rmse_m;
  const TrustScore trust = trust_score(run, result);
  score.online.rmse_m += share * online.rmse_m;
  score.online.anees += share * online.anees;
  score.smoothed.rmse_m += share * smoothed.rmse_m;
  score.smoothed.anees += share * smoothed.anees;
  score.odometry_m += share * odometry_m;
  score.mapped += share * map.mapped;
  score.duplicates += share * map.duplicates;
  score.trusted += share * trust.share;
  if (trust.share > 0.0) {
    score.worst_trusted_anees = std::max(score.worst_trusted_anees, trust.anees);
    score.trusted_in_vain += trust.anees > 6.0 ? 1 : 0;
  }
  score.worse_than_odometry += online.rmse_m > odometry_m ? 1 : 0;
}

void print(const LabScore& score) {
  fmt::print(
      "odometry {:.3f} m  online {:.3f} m (ANEES {:.1f})  smoothed {:.3f} m ({:.1f})  worse than odometry {}  mapped "
      "{:.1f} duplicates {:.1f}  trusted {:.2f}, at worst ({:.1f}), above 6: {}\n",
      score.odometry_m, score.online.rmse_m, score.online.anees, score.smoothed.rmse_m, score.smoothed.anees,
      score.worse_than_odometry, score.mapped, score.duplicates, score.trusted, score.worst_trusted_anees,
      score.trusted_in_vain);
}

TEST(NamelessOnRuns, LabRunsAreTwiceAsGoodAsOdometry) {
  AZIMUTH_REQUIRE_DATA("lab-runs");
  constexpr int kRuns = 20;
  LabScore score;
  for (int i = 0; i < kRuns; ++i) {
    const auto run = load_run(test::data_folder() / fmt::format("lab-runs/lab-{:03}", i));
    ASSERT_TRUE(run) << text(run.error());
    add(*run, 1.0 / kRuns, score);
  }
  print(score);
  EXPECT_LE(score.online.rmse_m, 0.16);
  EXPECT_LE(score.online.anees, 3.0);
  EXPECT_LE(score.smoothed.rmse_m, 0.085);
  EXPECT_LE(score.smoothed.anees, 5.5);
  EXPECT_LE(score.worse_than_odometry, 2);
  EXPECT_GE(score.mapped, 19.0);
  EXPECT_LE(score.duplicates, 0.5);
  EXPECT_GE(score.trusted, 0.5);
  EXPECT_EQ(score.trusted_in_vain, 0);
}

TEST(NamelessOnRuns, LabsOfOurOwnAreKnownForWhatTheyAre) {
  constexpr int kRuns = 20;
  LabScore score;
  for (int seed = 1; seed <= kRuns; ++seed) add(hidden_lab(static_cast<std::uint64_t>(seed)), 1.0 / kRuns, score);
  print(score);
  EXPECT_LE(score.online.rmse_m, 0.7 * score.odometry_m);
  EXPECT_GE(score.trusted, 0.3);
  EXPECT_LE(score.trusted_in_vain, 1);
}

}  // namespace
}  // namespace azimuth
