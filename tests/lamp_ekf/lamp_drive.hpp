#pragma once
#include <algorithm>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {

inline constexpr std::size_t kOneRound = 150;  // number of images

/// A run through an estimator, which can be stopped at any image.
struct LampDrive {
  explicit LampDrive(LampRun a_run, const LampEkfSettings& settings = {})
      : run(std::move(a_run)), ekf(run.rig, settings) {}

  void to(std::size_t image) {
    for (; next < image; ++next) {
      ekf.predict(run.motions[next]);
      ekf.update(run.sets[next]);
    }
  }
  Estimate estimate() const {
    Estimate now;
    ekf.estimate(now);
    return now;
  }
  double error_m(std::size_t image) const {
    return (estimate().T_map_body.position() - (inverse(run.truth[0]) * run.truth[image]).position()).norm();
  }

  LampRun run;
  LampEkfEstimator ekf;
  std::size_t next = 0;
};

/// The true lamp nearest to each lamp of the map, sorted.
inline std::vector<int> lamps_mapped(const LampDrive& drive) {
  std::vector<int> mapped;
  for (const LandmarkEstimate& landmark : drive.estimate().landmarks) {
    const Eigen::Vector2d p = drive.run.truth[0] * landmark.p_map_landmark_m;
    const auto nearest = std::ranges::min_element(
        drive.run.lamps, {}, [&](const Eigen::Vector3d& lamp) { return (lamp.head<2>() - p).norm(); });
    EXPECT_LT((nearest->head<2>() - p).norm(), 1.0) << "clutter at " << p.transpose();
    mapped.push_back(static_cast<int>(nearest - drive.run.lamps.begin()));
  }
  std::ranges::sort(mapped);
  return mapped;
}

}  // namespace azimuth
