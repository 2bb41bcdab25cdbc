// Accuracy of the smoother, live and in hindsight, on recorded runs with known names.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ostream>

#include "tests/scenarios/replayed.hpp"
#include "tests/support/batch_solution.hpp"
#include "tests/support/data.hpp"
#include "tests/support/smoothed_run.hpp"

namespace azimuth {
namespace {

Run recorded(const std::string& name) {
  auto run = load_run(test::data_folder() / name);
  EXPECT_TRUE(run) << text(run.error());
  return run ? *std::move(run) : Run{};
}

struct Judged {
  RunError online, smoothed;
};

Judged judged(const std::string& name) {
  const Run run = recorded(name);
  const Rig rig = rig_of(run);
  const SmoothedRun result = smoothed_run(run, rig, settings_for(rig, SmootherSettings{}));
  const Judged errors{run_error(run, result.online), run_error(run, result.smoothed)};
  fmt::print("{:<20} online {:.3f} m (ANEES {:.1f})  smoothed {:.3f} m ({:.1f})  {} poses\n", name,
             errors.online.rmse_m, errors.online.anees, errors.smoothed.rmse_m, errors.smoothed.anees, result.poses);
  return errors;
}

struct SmootherLimit {
  const char* run;
  double online_m, smoothed_m, anees;
};
std::ostream& operator<<(std::ostream& out, const SmootherLimit& limit) { return out << limit.run; }

class SmootherOnRuns : public testing::TestWithParam<SmootherLimit> {};

TEST_P(SmootherOnRuns, KnowsWhereItWas) {
  AZIMUTH_REQUIRE_DATA(GetParam().run);
  const Judged errors = judged(GetParam().run);
  EXPECT_LE(errors.online.rmse_m, GetParam().online_m);
  EXPECT_LE(errors.smoothed.rmse_m, GetParam().smoothed_m);
  EXPECT_LE(errors.online.anees, GetParam().anees);
}

INSTANTIATE_TEST_SUITE_P(Runs, SmootherOnRuns,
                         testing::Values(SmootherLimit{"mrclam6-robot1", 0.45, 0.20, 4.0},
                                         SmootherLimit{"mrclam6-robot2", 0.22, 0.12, 8.0},
                                         SmootherLimit{"mrclam6-robot3", 0.19, 0.11, 4.0},
                                         SmootherLimit{"course-301", 0.12, 0.03, 4.0}),
                         [](const auto& instance) {
                           std::string name = instance.param.run;
                           std::erase(name, '-');
                           return name;
                         });

TEST(SmootherOnLabRuns, IsAccurateAndHonest) {
  AZIMUTH_REQUIRE_DATA("lab-runs");
  constexpr int kRuns = 20;
  Judged sum;
  for (int i = 0; i < kRuns; ++i) {
    const Judged errors = judged(fmt::format("lab-runs/lab-{:03}", i));
    sum.online.rmse_m += errors.online.rmse_m;
    sum.online.anees += errors.online.anees;
    sum.smoothed.rmse_m += errors.smoothed.rmse_m;
    sum.smoothed.anees += errors.smoothed.anees;
  }
  EXPECT_LE(sum.online.rmse_m / kRuns, 0.10);
  EXPECT_LE(sum.smoothed.rmse_m / kRuns, 0.06);
  for (const double anees : {sum.online.anees / kRuns, sum.smoothed.anees / kRuns}) {
    EXPECT_GE(anees, 2.0);
    EXPECT_LE(anees, 4.0);
  }
}

TEST(SmootherOnMrclam, EndsWhereTheBatchSolutionDoes) {
  AZIMUTH_REQUIRE_DATA("mrclam6-robot3");
  const auto run = recorded("mrclam6-robot3");
  const Rig rig = rig_of(run);
  SmootherSettings settings;
  const KnownNamesSettings names = settings_for(rig, settings);
  // GIVEN the live result, with four solver steps per image
  std::optional<Smoother> last;
  std::size_t images = 0;
  smoothed_run(run, rig, names, [&](const KnownNames& solved) {
    if (++images == run.bearings.size()) last = solved.smoother();
  });
  ASSERT_TRUE(last);
  BatchProblem batch(last->graph(), settings);
  ASSERT_GT(batch.solve(), 0);
  // THEN its energy equals that of the batch solution, within the convergence settings
  EXPECT_NEAR(last->energy(), batch.energy(), 3.0 * settings.converged_below);
  EXPECT_LT(largest_difference(last->graph().values(), batch.values()), 0.01);
}

}  // namespace
}  // namespace azimuth
