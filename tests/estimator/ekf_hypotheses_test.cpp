// Several hypotheses about the data association of the first images, followed side by side.

#include "slam/planar/ekf_hypotheses.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <utility>

#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

constexpr int kMost = 6;

struct Followed {
  std::size_t most = 0, at_the_end = 0;
  bool counts_went_back = false, counts_differ_from_map = false;
};

/// Follows a drive among landmarks of two colours.
Followed drive(std::uint64_t seed) {
  const Scenario scenario = coloured_lab(seed);
  World world = simulate(scenario);
  Rig rig = rig_of(scenario);
  rig.front_end = FrontEnd::colour;
  rig.camera.identities = false;
  auto owned = std::make_unique<EkfHypotheses>(std::make_unique<EkfEstimator>(rig, EkfSettings{}), kMost);
  const EkfHypotheses& estimator = *owned;
  EstimatorStage stage(std::move(owned), rig, StageSettings{});
  for (const OdometryReading& reading : world.odometry) stage.add(reading);
  Followed followed;
  AssociationCounts before;
  Estimate estimate;
  for (BearingSet& set : world.bearings) {
    for (Bearing& bearing : set.bearings) {
      bearing.kind = static_cast<Kind>(bearing.identity % 2);
      bearing.identity = kUnknownIdentity;
    }
    stage.add(set);
    while (stage.advance(estimate)) {
      const AssociationCounts& counts = estimate.association;
      followed.counts_went_back |= counts.accepted < before.accepted || counts.created < before.created ||
                                   counts.deleted < before.deleted || counts.rejected < before.rejected;
      followed.counts_differ_from_map |= counts.created - counts.deleted != estimate.landmarks.size();
      before = counts;
      followed.most = std::max(followed.most, estimator.size());
      followed.at_the_end = estimator.size();
    }
  }
  return followed;
}

TEST(EkfHypotheses, AreFewAndOneInTheEndAndCountOn) {
  std::size_t most = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Followed followed = drive(seed);
    most = std::max(most, followed.most);
    EXPECT_LE(followed.most, static_cast<std::size_t>(kMost)) << seed;
    EXPECT_EQ(followed.at_the_end, 1u) << seed;
    EXPECT_FALSE(followed.counts_went_back) << seed;
    EXPECT_FALSE(followed.counts_differ_from_map) << seed;
  }
  EXPECT_GT(most, 1u);
}

}  // namespace
}  // namespace azimuth
