#include "slam/planar/candidates.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/estimator/candidate_drive.hpp"

namespace azimuth {
namespace {

using namespace test::candidate;

TEST(Candidates, FirstSightingClonesThePresentPose) {
  Drive drive({});
  drive.go(1.0);
  drive.look(kOne, {0});
  ASSERT_EQ(drive.clones(), 1u);
  const JointState& state = drive.ekf.state();
  const Index clone = drive.candidates.clones().front().block;
  EXPECT_EQ(state.pose(clone), state.pose());
  EXPECT_EQ(state.pose_covariance(clone), state.pose_covariance());
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(state.covariance(clone + i, i), state.covariance(i, i));  // fully correlated
  expect_consistent(drive);
  EXPECT_TRUE(drive.candidates.created().empty());
}

TEST(Candidates, LandmarksOfOneImageShareAClone) {
  Drive drive({});
  drive.look({{3.0, 2.0}, {4.0, -2.0}, {6.0, 0.5}}, {0, 1, 2});
  EXPECT_EQ(drive.clones(), 1u);
  EXPECT_EQ(drive.candidates.clones().front().users, 3);
}

TEST(Candidates, ImageWithoutUnmappedLandmarksMakesNoClone) {
  Drive drive({});
  drive.look({}, {});
  EXPECT_EQ(drive.clones(), 0u);
  EXPECT_EQ(drive.candidates.images(), 1u);
}

/// mathematics I.2, steps 4 to 7, written out: three sightings, the better pair, one update with the third.
struct ByHand {
  ByHand() {
    blocks[0] = ekf.clone_robot();
    ekf.predict(straight_on(1.0));
    blocks[1] = ekf.clone_robot();
    ekf.predict(straight_on(1.0));
  }

  void initialise(const std::array<double, 3>& azimuths_rad, std::size_t used) {
    const Sighting here = ekf.sighting_from(0, azimuths_rad[2]);
    const Index clone = blocks.at(used);
    const auto meeting = intersect(ekf.sighting_from(clone, azimuths_rad.at(used)), here);
    landmark = ekf.add_point(*meeting, clone, 0, kSigma_rad);
    const MappedSighting rest{blocks.at(1 - used), landmark, BlockKind::point, azimuths_rad.at(1 - used),
                              kSigma_rad * kSigma_rad};
    ekf.update({&rest, 1});
    for (const Index block : blocks) ekf.remove(block, BlockKind::pose);
  }

  double relative_entropy(const std::array<double, 3>& azimuths_rad, std::size_t used) const {
    const Index clone = blocks.at(used);
    return QualityTest(EkfSettings{}.delayed.kl_samples)
        .relative_entropy(ekf.sighting_from(clone, azimuths_rad.at(used)), ekf.sighting_from(0, azimuths_rad[2]),
                          ekf.joint_pose_covariance(clone, 0), kSigma_rad);
  }

  BearingEkf ekf{BearingEkfSettings{}};
  std::array<Index, 2> blocks{};
  Index landmark = 0;
};

class AgainstByHand : public testing::TestWithParam<bool> {};

TEST_P(AgainstByHand, PairIsUsedUpTheRestAppliedAndClonesDropped) {
  const bool best_pair = GetParam();
  Drive drive(settings_with([&](EkfSettings& settings) {
    settings.delayed.min_observations = 3;
    settings.delayed.kl_threshold = 1.0;
    settings.delayed.best_pair = best_pair;
  }));
  // The later pair is the better one: the landmark is far from the first pose, and the first pose is more uncertain
  // relative to the last.
  const Landmarks landmarks{{1.6, 0.9}};
  std::array<double, 3> azimuths_rad{};
  for (std::size_t image = 0; image < 3; ++image) {
    if (image > 0) drive.go(1.0);
    azimuths_rad.at(image) = drive.bearing_of(landmarks, 0).azimuth_rad + (image == 1 ? 0.004 : 0.0);
    Bearing bearing = drive.bearing_of(landmarks, 0);
    bearing.azimuth_rad = azimuths_rad.at(image);
    drive.candidates.observe(drive.ekf, {&bearing, 1});
  }
  ASSERT_EQ(drive.candidates.created().size(), 1u);
  const Candidates::Created& created = drive.candidates.created().front();
  EXPECT_EQ(created.identity, 0);
  EXPECT_EQ(created.sightings, 3u);

  ByHand by_hand;
  const std::array<double, 2> entropies{by_hand.relative_entropy(azimuths_rad, 0),
                                        by_hand.relative_entropy(azimuths_rad, 1)};
  ASSERT_LT(std::max(entropies[0], entropies[1]), 1.0);
  ASSERT_LT(entropies[1], entropies[0]);
  const std::size_t used = best_pair ? 1 : 0;
  EXPECT_EQ(created.relative_entropy, entropies.at(used));
  by_hand.initialise(azimuths_rad, used);

  const JointState &state = drive.ekf.state(), &expected = by_hand.ekf.state();
  EXPECT_LT((state.position(created.block) - expected.position(by_hand.landmark)).norm(), 1e-12);
  EXPECT_LT((state.position_covariance(created.block) - expected.position_covariance(by_hand.landmark)).norm(), 1e-13);
  EXPECT_LT((state.pose().vector() - expected.pose().vector()).norm(), 1e-12);
  EXPECT_LT((state.pose_covariance() - expected.pose_covariance()).norm(), 1e-13);
  EXPECT_EQ(drive.clones(), 0u);
  EXPECT_TRUE(drive.candidates.candidates().empty());
  expect_consistent(drive);
}

INSTANTIATE_TEST_SUITE_P(Pair, AgainstByHand, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Best" : "First"; });

TEST(Candidates, InitialisedLandmarkStandsWhereItIs) {
  Drive drive({});
  for (int image = 0; image < 8 && drive.candidates.created().empty(); ++image) {
    drive.look(kOne, {0});
    drive.go(0.4);
  }
  ASSERT_EQ(drive.candidates.created().size(), 1u);
  const Index block = drive.candidates.created().front().block;
  EXPECT_LT((drive.ekf.state().position(block) - kOne[0]).norm(), 1e-6);  // there is no noise
  EXPECT_LT(drive.candidates.created().front().relative_entropy, EkfSettings{}.delayed.kl_threshold);
}

TEST(Candidates, WithoutParallaxNothingIsInitialised) {
  Drive drive({});
  const Landmarks ahead{{12.0, 0.0}};
  for (int image = 0; image < 8; ++image) {
    drive.look(ahead, {0});
    EXPECT_TRUE(drive.candidates.created().empty());
    drive.go(0.5);
  }
  EXPECT_EQ(drive.sightings(0), 8u);
}

TEST(Candidates, AWrongRemainingBearingIsGated) {
  for (const bool gate : {true, false}) {
    Drive drive(settings_with([&](EkfSettings& settings) {
      settings.delayed.min_observations = 3;
      settings.delayed.gate_remaining = gate;
    }));
    for (int image = 0; image < 3; ++image) {
      if (image > 0) drive.go(1.0);
      Bearing bearing = drive.bearing_of(kOne, 0);
      if (image == 1) bearing.azimuth_rad += 0.5;
      drive.candidates.observe(drive.ekf, {&bearing, 1});
    }
    ASSERT_EQ(drive.candidates.created().size(), 1u);
    const double error_m = (drive.ekf.state().position(drive.candidates.created().front().block) - kOne[0]).norm();
    EXPECT_EQ(error_m < 0.01, gate) << error_m;
  }
}

}  // namespace
}  // namespace azimuth
