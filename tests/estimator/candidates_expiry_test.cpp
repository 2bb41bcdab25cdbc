// How long the bearings of landmarks that are not mapped yet are kept, and how many of them.

#include <array>
#include <gtest/gtest.h>
#include <set>

#include "slam/geometry/angle.hpp"
#include "slam/planar/candidates.hpp"
#include "tests/estimator/candidate_drive.hpp"

namespace azimuth {
namespace {

using namespace test::candidate;

TEST(Candidates, NotSeenWhileClonesAreMadeExpires) {
  Drive drive(settings_with([](EkfSettings& settings) { settings.delayed.expire_after_clones = 5; }));
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
  Drive drive(settings_with([](EkfSettings& settings) { settings.delayed.expire_after_clones = 5; }));
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
  Drive drive(settings_with([](EkfSettings& settings) { settings.delayed.min_clone_baseline_m = 0.1; }));
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
    settings.delayed.max_clones = 6;
    settings.delayed.expire_after_clones = 0;
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
  // One of the two bearings is misread: it belongs to another object.
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
