// Whether the errors of FastSLAM in pose and map agree with its covariances.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "slam/particles/fastslam_estimator.hpp"
#include "tests/support/data.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

/// Values of one drive, or their means over several drives.
struct Consistency {
  double nees = 0.0;       ///< NEES of the pose while health says `tracking`; 3 is ideal
  double lamp_nees = 0.0;  ///< NEES of the lamps in the plane at the end; 2 is ideal
  double squared_error_m2 = 0.0, variance_m2 = 0.0;
};

double squared_error(const LandmarkEstimate& landmark, const LampRun& run) {
  Eigen::Vector2d nearest = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  for (const Eigen::Vector3d& lamp : run.lamps) {
    const Eigen::Vector2d off = inverse(run.truth[0]) * Eigen::Vector2d(lamp.head<2>()) - landmark.p_map_landmark_m;
    if (off.norm() < nearest.norm()) nearest = off;
  }
  return nearest.dot(landmark.covariance_m2.inverse() * nearest);
}

Consistency driven(const LampRun& run, int seed) {
  FastSlamSettings settings;
  settings.seed = seed;
  FastSlamEstimator estimator(run.rig, settings);
  Estimate estimate;
  Consistency result;
  double images = 0.0;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
    estimate.landmarks.clear();
    estimator.estimate(estimate);
    if (estimate.health != Health::tracking) continue;
    const Pose2 T_first_body = inverse(run.truth[0]) * run.truth[i];
    result.nees += squared_error(estimate, T_first_body);
    result.squared_error_m2 += (estimate.T_map_body.position() - T_first_body.position()).squaredNorm();
    result.variance_m2 += estimate.pose_covariance.topLeftCorner<2, 2>().trace();
    images += 1.0;
  }
  EXPECT_GT(images, 150.0);
  for (double* sum : {&result.nees, &result.squared_error_m2, &result.variance_m2}) *sum /= images;
  for (const LandmarkEstimate& landmark : estimate.landmarks)
    result.lamp_nees += squared_error(landmark, run) / static_cast<double>(estimate.landmarks.size());
  return result;
}

struct Drives {
  Consistency mean;
  double worst_nees = 0.0;
  int beyond_chance = 0;  ///< Number of drives whose mean NEES exceeds the 99 % quantile
  double sigma_over_rmse() const { return std::sqrt(mean.variance_m2 / mean.squared_error_m2); }
};

Drives drives(const char* name, int count, const std::function<LampRun(int)>& make) {
  constexpr double kOneInAHundred = 11.34;  // chi squared, 3 degrees of freedom
  Drives all;
  for (int i = 0; i < count; ++i) {
    const Consistency one = driven(make(i), 1 + i);
    all.mean.nees += one.nees / count;
    all.mean.lamp_nees += one.lamp_nees / count;
    all.mean.squared_error_m2 += one.squared_error_m2 / count;
    all.mean.variance_m2 += one.variance_m2 / count;
    all.worst_nees = std::max(all.worst_nees, one.nees);
    all.beyond_chance += one.nees > kOneInAHundred ? 1 : 0;
  }
  fmt::print("{}: ANEES {:.2f} (worst {:.2f}), of lamps {:.2f}; RMSE {:.3f} m, sigma {:.3f} m\n", name, all.mean.nees,
             all.worst_nees, all.mean.lamp_nees, std::sqrt(all.mean.squared_error_m2), std::sqrt(all.mean.variance_m2));
  return all;
}

void expect_honest(const Drives& all) {
  EXPECT_GE(all.mean.nees, 1.0);
  EXPECT_LE(all.mean.nees, 5.0);
  EXPECT_LE(all.mean.lamp_nees, 4.5);
  EXPECT_GE(all.sigma_over_rmse(), 0.7);
  EXPECT_LE(all.sigma_over_rmse(), 2.0);
}

TEST(FastSlamConsistency, OfSimulatedHalls) {
  const auto regular = [](int i) { return simulated_hall(static_cast<std::uint64_t>(100 + i)); };
  const auto irregular = [](int i) { return simulated_hall(static_cast<std::uint64_t>(200 + i), 1.0); };
  for (const Drives& all : {drives("lamps on a grid", 20, regular), drives("lamps off it", 20, irregular)}) {
    expect_honest(all);
    EXPECT_LE(all.beyond_chance, 1);
  }
}

/// The odometry of these runs has larger errors than their rigs say, by a factor of 1.1 in the heading.
TEST(FastSlamConsistency, OfHallRuns) {
  AZIMUTH_REQUIRE_DATA("hall-runs");
  const Drives all = drives("hall-runs", 10, [](int i) {
    return recorded_hall(test::data_folder() / "hall-runs" / fmt::format("hall-{:03}", i));
  });
  expect_honest(all);
  EXPECT_LE(all.beyond_chance, 2);
}

}  // namespace
}  // namespace azimuth
