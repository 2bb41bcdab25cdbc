// A particle checks only the lamps near it for missed detections. The result must equal that of checking all lamps.

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "slam/fastslam/fastslam.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/geometry/random.hpp"
#include "slam/particles/lamp_association.hpp"

namespace azimuth {
namespace {

TEST(SlotSet, IsASet) {
  constexpr std::size_t kSlots = 150;
  RandomNumbers<Xoshiro> random(Xoshiro(3));
  const auto any_slot = [&] { return std::min(static_cast<std::size_t>(random.uniform() * kSlots), kSlots - 1); };
  std::vector<std::uint64_t> words(SlotSet<>::words_for(kSlots));
  ASSERT_EQ(words.size(), 3U);
  SlotSet set{std::span(words)};
  std::set<std::size_t> expected;
  for (int change = 0; change < 2000; ++change) {
    const std::size_t slot = any_slot();
    EXPECT_EQ(set.contains(slot), expected.contains(slot));
    if (change % 3 == 0) {
      set.erase(slot);
      expected.erase(slot);
    } else if (change % 3 == 1) {
      set.insert(slot);
      expected.insert(slot);
    } else if (change % 20 == 2) {
      std::vector<std::size_t> found;
      set.for_each_from_last([&](std::size_t at) { found.push_back(at); });
      EXPECT_EQ(found, (std::vector<std::size_t>{expected.rbegin(), expected.rend()}));
    }
  }
}

TEST(SlotSet, MayLoseWhatIsVisited) {
  std::vector<std::uint64_t> words(2);
  SlotSet set{std::span(words)};
  for (const std::size_t slot : {0U, 5U, 63U, 64U, 127U}) set.insert(slot);
  std::vector<std::size_t> found;
  set.for_each_from_last([&](std::size_t slot) {
    found.push_back(slot);
    set.erase(127);
    set.erase(slot);
  });
  EXPECT_EQ(found, (std::vector<std::size_t>{127, 64, 63, 5, 0}));
  EXPECT_EQ(words, (std::vector<std::uint64_t>{0, 0}));
}

TEST(NearLamps, FollowTheirLandmarksThroughSlotsAndParticles) {
  Particles particles(3, 70, 1);
  for (int n = 0; n < 70; ++n) particles.add_landmark(0, {1.0 * n, 0.0, 0.0}, {}, {.id = n});
  const auto ids_nearby = [&](std::size_t k) {
    std::set<std::int64_t> ids;
    particles.nearby(k).for_each_from_last([&](std::size_t slot) { ids.insert(particles.infos(k)[slot].id); });
    return ids;
  };
  EXPECT_EQ(ids_nearby(0).size(), 70U) << "nobody knows better of new ones";
  for (std::size_t slot = 0; slot < 70; ++slot)
    if (slot % 2 == 0) particles.nearby(0).erase(slot);
  particles.remove_landmark(0, 5);   // lamp 69, which is nearby, moves to its slot
  particles.remove_landmark(0, 7);   // lamp 68, which is not nearby, moves to its slot
  particles.remove_landmark(0, 67);  // the last slot
  std::set<std::int64_t> odd;
  for (int id = 1; id < 70; id += 2) odd.insert(id);
  for (const int gone : {5, 7, 67}) odd.erase(gone);
  EXPECT_EQ(ids_nearby(0), odd);
  particles[0].asked_from_m = {3.0, 4.0};
  particles.resample(std::vector<std::size_t>{0, 0, 2}, 0);
  EXPECT_EQ(ids_nearby(1), odd);
  EXPECT_EQ(particles[1].asked_from_m, (Eigen::Vector2d{3.0, 4.0}));
  EXPECT_TRUE(ids_nearby(2).empty());
}

/// A lamp without identity is seen at the image's rim, a metre farther out than where a miss counts. The robot has
/// driven so far that all landmarks are checked anew, but the image's evidence must count at once.
TEST(NearLamps, WhatIsSeenAtTheRimIsRefutedAtOnce) {
  const LampCamera camera{0.5, 1.2, 0.85, false};
  constexpr double kManyLights = 1e12;
  FastSlamSettings settings;
  settings.particles = 10;
  settings.view.inner_margin = 0.1;
  FastSlam filter(settings, camera);
  LampAssociation association{LampAssociationMethod::hungarian, LampCost::logarithm};
  const Eigen::Vector3d p_map(0.0, 0.0, 3.0);
  double x_m = -2.0;
  const auto look_from = [&](double next_m, double lights) {
    Motion motion;
    motion.T_start_end = {next_m - x_m, 0.0, 0.0};
    motion.covariance = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
    motion.path_m = std::abs(next_m - x_m);
    x_m = next_m;
    filter.predict(motion);
    const Eigen::Vector2d z = direction_of(view(Viewpoint(Pose2{x_m, 0.0, 0.0}, camera.height_m), p_map), 0.0);
    const std::vector<LampSighting> seen{make_sighting(z.x(), z.y(), {1e-5, 0.0, 1e-5}, kUnknownIdentity)};
    filter.update(seen, association, static_cast<std::size_t>(lights));
  };
  while (filter.particles().infos(filter.best()).empty() && x_m < 2.0) look_from(x_m + 0.1, 1);
  ASSERT_EQ(filter.particles().infos(filter.best()).size(), 1U);
  ASSERT_EQ(filter.proven(), 0U);
  look_from(6.2, kManyLights);
  EXPECT_TRUE(filter.particles().infos(filter.best()).empty());
}

/// Two rows of lamps above a corridor, along which a robot drives to and fro.
struct Corridor : testing::Test {
  static constexpr double kHeight_m = 0.5, kCeiling_m = 3.0, kSpacing_m = 3.0, kMaxZenith_rad = 1.0;
  static constexpr int kPairs = 12;

  void SetUp() override {
    for (int n = 0; n < kPairs; ++n)
      for (const double side_m : {-1.5, 1.5}) lamps.emplace_back(kSpacing_m * n, side_m, kCeiling_m);
    drive(kSpacing_m * (kPairs - 1));
  }
  void drive(double distance_m) {
    const int steps = static_cast<int>(std::abs(distance_m) / 0.1);
    for (int n = 0; n < steps; ++n) {
      const double stride_m = distance_m / steps;
      x_m += stride_m;
      Motion motion;
      motion.T_start_end = {stride_m, 0.0, 0.0};
      motion.covariance = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
      motion.path_m = std::abs(stride_m);
      filter.predict(motion);
      look();
      filter.update(seen, association);
    }
  }
  void look() {
    const Viewpoint from(Pose2{x_m, 0.0, 0.0}, kHeight_m);
    seen.clear();
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const Eigen::Vector2d z = direction_of(view(from, lamps[i]), 0.0);
      if (z.y() < kMaxZenith_rad && !dark.contains(i))
        seen.push_back(make_sighting(z.x(), z.y(), {1e-5, 0.0, 1e-5}, static_cast<Identity>(i)));
    }
  }
  std::set<Identity> mapped() const {
    std::set<Identity> names;
    for (const LampInfo& info : filter.particles().infos(filter.best())) names.insert(info.identity);
    return names;
  }
  static FastSlamSettings settings() {
    FastSlamSettings settings;
    settings.particles = 10;
    return settings;
  }

  std::vector<Eigen::Vector3d> lamps;
  std::set<std::size_t> dark;
  FastSlam filter{settings(), {kHeight_m, kMaxZenith_rad, 0.85, true}};
  LampAssociation association{LampAssociationMethod::hungarian, LampCost::logarithm};
  std::vector<LampSighting> seen;
  double x_m = 0.0;
};

TEST_F(Corridor, OfLampsThatWentOutWhileFarOffTheMapIsRidWhenTheRobotComesBack) {
  ASSERT_EQ(mapped().size(), lamps.size());
  dark = {0, 7};
  drive(-kSpacing_m * 3);
  EXPECT_EQ(mapped().size(), lamps.size()) << "both are out of view yet";
  drive(-kSpacing_m * (kPairs - 4));
  std::set<Identity> lit;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (!dark.contains(i)) lit.insert(static_cast<Identity>(i));
  EXPECT_EQ(mapped(), lit);
}

TEST_F(Corridor, LampsOutOfViewAreNeverMissed) {
  const std::uint64_t deleted = filter.counts().deleted;
  for (int n = 0; n < 5; ++n) {
    drive(-kSpacing_m * 2);
    drive(kSpacing_m * 2);
  }
  EXPECT_EQ(mapped().size(), lamps.size());
  EXPECT_EQ(filter.counts().deleted, deleted);
}

}  // namespace
}  // namespace azimuth
