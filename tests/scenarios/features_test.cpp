// Features that only their descriptors identify (mathematics I.12 to I.14).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/data.hpp"
#include "tests/support/feature_world.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

constexpr int kFeatureSeeds = 3;

struct FeatureOutcome {
  Runs runs;
  std::size_t accepted = 0, wrong = 0;

  double wrong_share() const { return static_cast<double>(wrong) / static_cast<double>(accepted); }
};

FeatureOutcome drive_through_features(const EkfSettings& settings, const FeatureWorldSettings& world_settings = {},
                                      int seeds = kFeatureSeeds) {
  FeatureOutcome outcome;
  outcome.runs = replay_seeds(seeds, [&](std::uint64_t seed) {
    const FeatureWorld world = feature_world(seed, world_settings);
    Rig rig = rig_of(world.run);
    rig.front_end = FrontEnd::sift;
    rig.camera.identities = false;
    const ReplayResult result = replay(world.run, rig, make_ekf_estimator(rig, settings), StageSettings{});
    outcome.accepted += result.sightings.size();
    outcome.wrong += world.wrong(result.sightings);
    return evaluate(replay_record(world.run, rig, "ekf", seed, result));
  });
  return outcome;
}

class Features : public testing::TestWithParam<FeatureValidation> {};

TEST_P(Features, AreToldApartByTheirLooks) {
  // GIVEN a room full of features: an image shows 70 % of those in range, some look alike, some are clutter
  EkfSettings settings;
  settings.identity.validation = GetParam();
  // WHEN a robot drives two laps through the room
  const FeatureOutcome outcome = drive_through_features(settings);
  outcome.runs.print("features");
  fmt::print("wrong identities: {} of {} accepted\n", outcome.wrong, outcome.accepted);
  // THEN the identities are right, the pose error is small and its covariance consistent
  EXPECT_GT(outcome.accepted, 4000u);
  EXPECT_LT(outcome.wrong_share(), 0.01);
  EXPECT_EQ(outcome.runs.diverged(), 0);
  EXPECT_LE(outcome.runs.mean_m(), 0.10);
  EXPECT_GE(outcome.runs.anees(), 0.7);  // low because the rig is exact, which the filter does not assume
  EXPECT_LE(outcome.runs.anees(), 6.0);
}

INSTANTIATE_TEST_SUITE_P(Validations, Features,
                         testing::Values(FeatureValidation::geometry, FeatureValidation::patterns,
                                         FeatureValidation::combined),
                         test::PrintedName());

TEST(FeaturesOfPoorRepeatability, AreStillEnough) {
  // The heading of this odometry also drifts too fast for delayed initialisation.
  const FeatureOutcome outcome =
      drive_through_features({}, {.repeatability = 0.55, .look_alikes = 0.3, .heading_drift_rad2_per_m = 1e-3}, 2);
  outcome.runs.print("features, poor");
  fmt::print("wrong identities: {} of {} accepted\n", outcome.wrong, outcome.accepted);
  EXPECT_LT(outcome.wrong_share(), 0.01);
  EXPECT_EQ(outcome.runs.diverged(), 0);
  EXPECT_LE(outcome.runs.mean_m(), 0.15);
}

}  // namespace
}  // namespace azimuth
