#include "slam/planar/candidates.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kSigma_rad = 0.01;

Motion straight_on(double distance_m) {
  Motion motion;
  motion.T_start_end.x_m = distance_m;
  motion.covariance.diagonal() << 4e-4, 1e-4, 1e-4;
  motion.covariance *= distance_m;
  motion.path_m = distance_m;
  return motion;
}

EkfSettings settings_with(const std::function<void(EkfSettings&)>& change) {
  EkfSettings settings;
  settings.min_clone_baseline_m = 0.0;
  change(settings);
  return settings;
}

CameraRig camera() {
  CameraRig rig;
  rig.sigma_bearing_rad = kSigma_rad;
  return rig;
}

using Landmarks = std::vector<Eigen::Vector2d>;  // the index is the identity

/// A filter whose robot drives along the x axis and sees landmarks without error.
struct Drive {
  explicit Drive(const EkfSettings& settings) : candidates(settings, camera()) {}

  void go(double distance_m) { ekf.predict(straight_on(distance_m)); }

  /// An image with these landmarks in it, all unmapped.
  void look(const Landmarks& landmarks, const std::vector<Identity>& seen) {
    std::vector<Bearing> bearings;
    for (const Identity identity : seen) bearings.push_back(bearing_of(landmarks, identity));
    candidates.observe(ekf, bearings);
  }
  Bearing bearing_of(const Landmarks& landmarks, Identity identity) const {
    const Eigen::Vector2d from_robot = landmarks[static_cast<std::size_t>(identity)] - ekf.state().position(0);
    Bearing bearing;
    bearing.azimuth_rad = wrap(std::atan2(from_robot.y(), from_robot.x()) - ekf.state().pose().heading_rad);
    bearing.identity = identity;
    return bearing;
  }

  std::size_t clones() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(candidates.clones(), [](const Candidates::Clone& clone) { return clone.block != 0; }));
  }
  std::size_t sightings(Identity identity) const {
    for (const Candidate& candidate : candidates.candidates())
      if (candidate.identity == identity) return candidate.count;
    return 0;
  }

  BearingEkf ekf{BearingEkfSettings{}};
  Candidates candidates;
};

/// What the clones' counts of users must say, whatever happened.
void expect_consistent(const Drive& drive) {
  std::vector<int> users(drive.candidates.clones().size(), 0);
  std::set<Identity> identities;
  for (const Candidate& candidate : drive.candidates.candidates()) {
    EXPECT_TRUE(identities.insert(candidate.identity).second) << "identity " << candidate.identity << " twice";
    EXPECT_GT(candidate.count, 0u);
    for (const Candidate::Bearing& bearing : candidate.seen()) {
      ASSERT_GE(bearing.clone, 0) << "a bearing was not cloned";
      ++users.at(static_cast<std::size_t>(bearing.clone));
    }
  }
  for (std::size_t slot = 0; slot < users.size(); ++slot) {
    const Candidates::Clone& clone = drive.candidates.clones()[slot];
    EXPECT_EQ(clone.users, users[slot]);
    EXPECT_EQ(clone.block != 0, users[slot] > 0);
  }
}

const Landmarks kOne{{3.0, 2.0}};

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

/// SPEC I.2, steps 4 to 7, written out: three sightings, the better pair, one update with the third.
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
    return QualityTest(EkfSettings{}.kl_samples)
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
    settings.min_observations = 3;
    settings.kl_threshold = 1.0;
    settings.best_pair = best_pair;
  }));
  // The later pair is the better one: at the first sighting the landmark is far, and the pose in between uncertain.
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
  EXPECT_LT((drive.ekf.state().position(block) - kOne[0]).norm(), 1e-6);  // there was no noise
  EXPECT_LT(drive.candidates.created().front().relative_entropy, EkfSettings{}.kl_threshold);
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
      settings.min_observations = 3;
      settings.gate_remaining = gate;
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

TEST(Candidates, NotSeenWhileClonesAreMadeExpires) {
  Drive drive(settings_with([](EkfSettings& settings) { settings.expire_after_clones = 5; }));
  const Landmarks landmarks{{3.0, 2.0}, {60.0, 0.0}};
  drive.look(landmarks, {0, 1});
  for (int image = 0; image < 5; ++image) {
    drive.go(0.5);
    drive.look(landmarks, {1});
    EXPECT_EQ(drive.sightings(0), 1u);
  }
  drive.go(0.5);
  drive.look(landmarks, {1});
  drive.go(0.5);
  drive.look(landmarks, {1});
  EXPECT_EQ(drive.sightings(0), 0u);
  EXPECT_EQ(drive.sightings(1), 8u);
  expect_consistent(drive);
}

TEST(Candidates, ARobotThatSeesNothingNewForgetsNothing) {
  Drive drive(settings_with([](EkfSettings& settings) { settings.expire_after_clones = 5; }));
  drive.look(kOne, {0});
  for (int image = 0; image < 100; ++image) drive.look(kOne, {});
  EXPECT_EQ(drive.sightings(0), 1u);
  EXPECT_EQ(drive.clones(), 1u);
}

TEST(Candidates, BeyondTwiceTheViewingDistanceExpires) {
  Drive drive(settings_with([](EkfSettings& settings) { settings.max_viewing_distance_m = 5.0; }));
  drive.look(kOne, {0});
  drive.go(9.9);
  drive.look(kOne, {});
  EXPECT_EQ(drive.sightings(0), 1u);
  drive.go(0.2);
  drive.look(kOne, {});
  EXPECT_EQ(drive.sightings(0), 0u);
  EXPECT_EQ(drive.clones(), 0u);
}

TEST(Candidates, BearingsFromNearlyTheSamePlaceMakeNoClone) {
  Drive drive(settings_with([](EkfSettings& settings) { settings.min_clone_baseline_m = 0.1; }));
  const Landmarks far{{60.0, 0.5}};
  for (int image = 0; image < 10; ++image) {
    drive.look(far, {0});
    drive.go(0.03);
  }
  EXPECT_EQ(drive.sightings(0), 3u);  // at 0, 0.12 and 0.24 m
  EXPECT_EQ(drive.clones(), 3u);
  expect_consistent(drive);
}

TEST(Candidates, ClonesAreBoundedAndTheOldestGivesWay) {
  Drive drive(settings_with([](EkfSettings& settings) {
    settings.max_clones = 6;
    settings.expire_after_clones = 0;
    settings.max_viewing_distance_m = 1000.0;
  }));
  Landmarks far;
  for (int i = 0; i < 40; ++i) far.emplace_back(500.0 + i, 0.0);
  Index extent = 0;
  for (Identity image = 0; image < 40; ++image) {
    drive.look(far, {image});  // every landmark once
    drive.go(0.5);
    EXPECT_LE(drive.clones(), 6u);
    expect_consistent(drive);
    if (image == 10) extent = drive.ekf.state().extent();
  }
  EXPECT_EQ(drive.ekf.state().extent(), extent);
  EXPECT_EQ(drive.candidates.candidates().size(), 6u);
  for (Identity newest = 34; newest < 40; ++newest) EXPECT_EQ(drive.sightings(newest), 1u);
}

TEST(Candidates, ALongListKeepsItsFirstBearingAndTheNewest) {
  Drive drive(settings_with([](EkfSettings& settings) { settings.max_viewing_distance_m = 1000.0; }));
  const Landmarks far{{900.0, 0.0}};
  for (int image = 0; image < 50; ++image) {
    drive.look(far, {0});
    drive.go(0.5);
  }
  ASSERT_EQ(drive.sightings(0), Candidate::kMaxBearings);
  const Candidate& candidate = drive.candidates.candidates().front();
  std::vector<std::uint64_t> images;
  for (const Candidate::Bearing& bearing : candidate.seen())
    images.push_back(drive.candidates.clones()[static_cast<std::size_t>(bearing.clone)].image);
  std::vector<std::uint64_t> expected{0};
  for (std::uint64_t image = 19; image < 50; ++image) expected.push_back(image);
  EXPECT_EQ(images, expected);
  expect_consistent(drive);
}

TEST(Candidates, TwoNamesInOneImageAreTwoLandmarks) {
  Drive drive({});
  const Landmarks landmarks{{3.0, 2.0}, {3.5, -2.0}};
  std::set<Identity> created;
  for (int image = 0; image < 10; ++image) {
    std::vector<Identity> unmapped;
    for (const Identity identity : {0, 1})
      if (!created.contains(identity)) unmapped.push_back(identity);
    drive.look(landmarks, unmapped);
    for (const Candidates::Created& landmark : drive.candidates.created())
      EXPECT_TRUE(created.insert(landmark.identity).second);
    expect_consistent(drive);
    drive.go(0.4);
  }
  EXPECT_EQ(created.size(), 2u);
  EXPECT_EQ(drive.clones(), 0u);
}

TEST(Candidates, OneNameTwiceInAnImageIsNeverTwoLandmarksOrAPairOfItself) {
  // A sensor misreads: one of the two bearings is of something else.
  Drive drive({});
  int created = 0;
  for (int image = 0; image < 10 && created == 0; ++image) {
    Bearing misread = drive.bearing_of(kOne, 0);
    misread.azimuth_rad = wrap(misread.azimuth_rad + 1.0);
    const std::array<Bearing, 2> both{drive.bearing_of(kOne, 0), misread};
    drive.candidates.observe(drive.ekf, both);
    expect_consistent(drive);
    created += static_cast<int>(drive.candidates.created().size());
    drive.go(0.4);
  }
  EXPECT_LE(created, 1);
  EXPECT_TRUE(std::isfinite(drive.ekf.state().pose_covariance().sum()));
}

}  // namespace
}  // namespace azimuth
