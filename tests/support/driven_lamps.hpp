#pragma once
// Shared by the tests of estimators under lamps: an estimator that is driven through a run, and a check that a map
// stays unchanged.

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <utility>

#include "slam/sample/map_snapshot.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth::test {

/// An estimator that is driven through a run under lamps.
template <class Estimator>
struct DrivenLamps {
  DrivenLamps(const LampRun& a_run, Estimator an_estimator, std::size_t first = 0)
      : run(a_run), estimator(std::move(an_estimator)), next(first) {}

  void step() {
    estimator.predict(run.motions[next]);
    estimator.update(run.sets[next++]);
  }
  void to(std::size_t image) {
    while (next < image) step();
  }
  Estimate estimate() const {
    Estimate now;
    estimator.estimate(now);
    return now;
  }
  Pose2 truth() const { return inverse(run.truth[0]) * run.truth[next - 1]; }
  double error_m() const { return (estimate().T_map_body.position() - truth().position()).norm(); }
  double nees() const { return squared_error(estimate(), truth()); }

  const LampRun& run;
  Estimator estimator;
  std::size_t next;
};

/// Expects that lamps and their covariance equal those of the map bit by bit. The numbers of sightings may differ.
inline void expect_same_lamps(const MapSnapshot& kept, const MapSnapshot& map) {
  ASSERT_EQ(kept.landmarks.size(), map.landmarks.size());
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    EXPECT_EQ(kept.landmarks[i].id, map.landmarks[i].id);
    EXPECT_EQ(kept.landmarks[i].p_map_landmark_m, map.landmarks[i].p_map_landmark_m);
    EXPECT_EQ(kept.landmarks[i].z_map_landmark_m, map.landmarks[i].z_map_landmark_m);
  }
  ASSERT_EQ(kept.entries(), map.entries());
  for (std::size_t entry = map.first_landmark_entry(); entry < map.entries(); ++entry)
    EXPECT_TRUE(std::ranges::equal(kept.covariance.below(entry), map.covariance.below(entry)));
}

}  // namespace azimuth::test
