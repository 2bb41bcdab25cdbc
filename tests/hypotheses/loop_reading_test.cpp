#include "slam/hypotheses/loop_reading.hpp"

#include <gtest/gtest.h>

#include "slam/geometry/index.hpp"
#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

constexpr double kSees_m = 6.0;
constexpr int kRead = 12;

std::vector<Eigen::Vector2d> scattered_landmarks(unsigned seed) {
  std::mt19937_64 numbers(seed);
  std::uniform_real_distribution<double> place(-9.0, 9.0);
  std::vector<Eigen::Vector2d> landmarks(24);
  for (Eigen::Vector2d& landmark : landmarks) landmark = {place(numbers), place(numbers)};
  return landmarks;
}

std::vector<MappedBefore> map_of(const std::vector<Eigen::Vector2d>& landmarks) {
  std::vector<MappedBefore> map;
  for (const Eigen::Vector2d& p : landmarks) {
    // The chart's origin is two metres away, and the position is known to 5 cm.
    const SmoothedLandmark where(p - Eigen::Vector2d(2.0, 0.0), 0.0, 0.5);
    const Eigen::Matrix2d by_place = where.p_by_chart().inverse();
    map.push_back({where, 0.05 * 0.05 * by_place * by_place.transpose(), kAnyKind});
  }
  return map;
}

struct ReadDrive {
  std::vector<ImageToRead> images;
  std::vector<Pose2> truth;
  std::vector<std::vector<int>> names;
};

ReadDrive read_drive(const std::vector<Eigen::Vector2d>& landmarks, unsigned seed) {
  NamelessWorld world(landmarks, seed);
  ReadDrive drive;
  for (int i = 0; i < kRead; ++i) {
    drive.truth.push_back(on_circle(i));
    ImageToRead& image = drive.images.emplace_back();
    if (i > 0) image.motion = world.motion(on_circle(i - 1), on_circle(i));
    image.sightings = world.sightings(on_circle(i), kSees_m, &drive.names.emplace_back());
  }
  return drive;
}

Scene scene_seen() { return world_settings().scene; }

TEST(LoopReading, FindsARobotThatIsMetresFromWhereItIsThought) {
  int found_right = 0;
  constexpr unsigned kDrives = 10;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    const std::vector<Eigen::Vector2d> landmarks = scattered_landmarks(seed);
    const ReadDrive drive = read_drive(landmarks, seed);
    const PositionPrior thought{drive.truth.front().position() + Eigen::Vector2d(1.5, -1.5), 3.0};
    const std::vector<PoseGaussian> found = find_in_map(map_of(landmarks), drive.images, scene_seen(), thought);
    if (found.empty()) continue;
    const Pose2 off = inverse(drive.truth.back()) * found.front().T_map_body;
    found_right += off.position().norm() < 0.15 && std::abs(off.heading_rad) < 0.05 ? 1 : 0;
  }
  EXPECT_GE(found_right, 8);
}

TEST(LoopReading, FindsNothingWhereNothingIsMappedOrSeen) {
  const std::vector<Eigen::Vector2d> landmarks = scattered_landmarks(1);
  ReadDrive drive = read_drive(landmarks, 1);
  const PositionPrior here{drive.truth.front().position(), 1.0};
  EXPECT_TRUE(find_in_map({}, drive.images, scene_seen(), here).empty());
  for (ImageToRead& image : drive.images) image.sightings.clear();
  EXPECT_TRUE(find_in_map(map_of(landmarks), drive.images, scene_seen(), here).empty());
  EXPECT_TRUE(find_in_map(map_of(landmarks), {}, scene_seen(), here).empty());
}

TEST(LoopReading, ReadsBackwardsFromAPoseThatIsKnown) {
  const std::vector<Eigen::Vector2d> landmarks = scattered_landmarks(3);
  const ReadDrive drive = read_drive(landmarks, 3);
  PoseGaussian last{drive.truth.back(), Eigen::Matrix3d::Zero()};
  last.covariance.diagonal() << 0.01, 0.01, 1e-3;
  const Reading reading = read_backwards(map_of(landmarks), drive.images, scene_seen(), 0.05, last);
  int right = 0, wrong = 0, all = 0;
  for (std::size_t i = 0; i < drive.images.size(); ++i) {
    EXPECT_LT((reading.poses[i].T_map_body.position() - drive.truth[i].position()).norm(), 0.2) << i;
    EXPECT_LT(std::abs(wrap(reading.poses[i].T_map_body.heading_rad - drive.truth[i].heading_rad)), 0.05) << i;
    ASSERT_EQ(reading.landmark_of[i].size(), drive.names[i].size());
    for (std::size_t b = 0; b < drive.names[i].size(); ++b) {
      const int read = reading.landmark_of[i][b];
      ++all;
      if (read >= 0) ++(read == drive.names[i][b] ? right : wrong);
    }
  }
  EXPECT_GT(right, 0.5 * all);
  EXPECT_LT(wrong, 0.02 * all);
}

TEST(LoopReading, WhatIsOfNothingMappedIsOfNothing) {
  const std::vector<Eigen::Vector2d> landmarks = scattered_landmarks(4);
  const ReadDrive drive = read_drive(landmarks, 4);
  PoseGaussian last{drive.truth.back(), 1e-4 * Eigen::Matrix3d::Identity()};
  const Reading reading = read_backwards({}, drive.images, scene_seen(), 0.05, last);
  for (const std::vector<int>& image : reading.landmark_of)
    for (const int landmark : image) EXPECT_EQ(landmark, -1);
}

}  // namespace
}  // namespace azimuth
