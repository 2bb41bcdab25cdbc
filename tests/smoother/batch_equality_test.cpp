// The incremental solution of the smoother equals the batch solution of all images.

#include <gtest/gtest.h>

#include "slam/smoother/smoother.hpp"
#include "tests/smoother/printed_kernel.hpp"
#include "tests/support/batch_solution.hpp"
#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

void expect_batch(const Smoother& smoother, const SmootherSettings& settings, double tolerance = 1e-6) {
  BatchProblem batch(smoother.graph(), settings);
  ASSERT_GT(batch.solve(), 0);
  EXPECT_LT(largest_difference(batch.values(), smoother.graph().values()), tolerance);
  EXPECT_NEAR(batch.energy(), smoother.energy(), 1e-7 * (1.0 + batch.energy()));
}

class BatchEqualityWith : public testing::TestWithParam<RobustKernel> {
 protected:
  static SmootherSettings settings() {
    SmootherSettings settings;
    settings.kernel = GetParam();
    settings.kernel_width = 2.0;
    settings.converged_below = 1e-18;
    return settings;
  }
};

TEST_P(BatchEqualityWith, WhenEveryImageIsSolvedToTheEnd) {
  const NamedDrive drive = named_drive({.images = 120, .outliers = GetParam() == RobustKernel::huber ? 0.02 : 0.0});
  Smoother smoother(settings());
  DriveFeeder feeder(drive);
  for (int image = 0; !feeder.done(); ++image) {
    feeder.feed(smoother);
    smoother.optimise(100);
    if (image % 30 == 10) expect_batch(smoother, settings());
  }
  expect_batch(smoother, settings());
}

TEST_P(BatchEqualityWith, AfterAFewStepsAnImageAndSomeAtTheEnd) {
  const NamedDrive drive = named_drive({.seed = 2, .images = 200});
  Smoother smoother(settings());
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise(4);
  }
  smoother.optimise(200);
  expect_batch(smoother, settings());
}

INSTANTIATE_TEST_SUITE_P(Kernel, BatchEqualityWith,
                         testing::Values(RobustKernel::none, RobustKernel::huber, RobustKernel::cauchy),
                         testing::PrintToStringParamName());

TEST(BatchEquality, ANarrowViewThatClosesLoops) {
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  const NamedDrive drive = named_drive({.seed = 5, .images = 300, .view_rad = 1.0, .sigma_rad = 0.04});
  Smoother smoother(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise(4);
  }
  smoother.optimise(200);
  expect_batch(smoother, settings);
}

TEST(BatchEquality, ChartsThatGoAlong) {
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  settings.charts_go_along = true;
  const NamedDrive drive = named_drive({.seed = 8, .images = 200, .outliers = 0.02});
  Smoother smoother(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise(4);
  }
  for (LandmarkId id = 0; id < smoother.graph().landmarks(); id += 3) smoother.use_prior(id, false);
  smoother.optimise(200);
  expect_batch(smoother, settings);
}

TEST(BatchEquality, LiveSettingsLeaveNextToNothing) {
  const SmootherSettings settings;
  const NamedDrive drive = named_drive({.seed = 6, .images = 300, .outliers = 0.02});
  Smoother smoother(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  BatchProblem batch(smoother.graph(), settings);
  ASSERT_GT(batch.solve(), 0);
  EXPECT_LT(smoother.energy() - batch.energy(), 3e-3);
}

TEST(BatchEquality, LittleIsDoneAnewWhenNothingMuchIsNew) {
  // GIVEN a drive of several laps that has mapped all landmarks
  const NamedDrive drive = named_drive({.seed = 7, .images = 600});
  Smoother smoother{SmootherSettings{}};
  DriveFeeder feeder(drive);
  std::size_t updated = 0, fronts = 0;
  for (int image = 0; !feeder.done(); ++image) {
    feeder.feed(smoother);
    smoother.optimise(1);
    if (image < 300) continue;
    updated += smoother.factor().updated();
    fronts += smoother.factor().fronts();
  }
  // THEN an image changes only a small part of the factor
  EXPECT_LT(static_cast<double>(updated), 0.4 * static_cast<double>(fronts));
}

}  // namespace
}  // namespace azimuth
