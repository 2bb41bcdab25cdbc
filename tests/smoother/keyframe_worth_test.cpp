// Selection of the keyframes with the least information.

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "slam/smoother/keyframe_limit.hpp"
#include "slam/smoother/known_names.hpp"
#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

std::vector<std::int32_t> in_order(const BearingGraph& graph) {
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(graph.poses()));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

Smoother driven(const NamedDrive& drive) {
  Smoother smoother{SmootherSettings{}};
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  return smoother;
}

TEST(KeyframeWorth, TheFirstAndTheNewestStay) {
  const Smoother smoother = driven(named_drive({.images = 60}));
  const auto poses =
      least_worth(smoother.graph(), in_order(smoother.graph()), 1000, {.newest_kept = 10, .fewest_bearings = 0});
  ASSERT_FALSE(poses.empty());
  EXPECT_GT(poses.front(), 0);
  EXPECT_LT(poses.back(), 50);
  EXPECT_TRUE(std::ranges::is_sorted(poses));
}

TEST(KeyframeWorth, AsManyOfTheOldestStayAsAreAskedFor) {
  const Smoother smoother = driven(named_drive({.images = 60}));
  const auto first_forgotten = [&](std::size_t oldest_kept) {
    return least_worth(smoother.graph(), in_order(smoother.graph()), 1000,
                       {.newest_kept = 10, .oldest_kept = oldest_kept, .fewest_bearings = 0})
        .front();
  };
  EXPECT_LT(first_forgotten(1), 7);
  EXPECT_GE(first_forgotten(7), 7);
}

TEST(KeyframeWorth, LandmarksKeepWhatTheyNeed) {
  const Smoother smoother = driven(named_drive({.seed = 4, .images = 200, .landmarks = 30, .range_m = 4.0}));
  const BearingGraph& graph = smoother.graph();
  const auto fits = [&](LandmarkId landmark, const std::vector<PoseId>& without) {
    return std::ranges::count_if(graph.bearings_of(landmark), [&](BearingId id) {
      return graph.chi2_of(id) < 9.0 && !std::ranges::binary_search(without, graph.bearing(id).pose);
    });
  };
  const auto poses = least_worth(graph, in_order(graph), 1000, {.newest_kept = 10, .fewest_bearings = 6});
  EXPECT_GT(poses.size(), 50U);
  for (LandmarkId landmark = 0; landmark < graph.landmarks(); ++landmark)
    EXPECT_GE(fits(landmark, poses), std::min<std::ptrdiff_t>(6, fits(landmark, {}))) << landmark;
}

TEST(KeyframeWorth, WhatIsSeenSeldomIsWorthMore) {
  // GIVEN images of landmarks 0 to 3, and in every tenth image also of a landmark that no other image shows
  NamedDrive drive = named_drive({.images = 100, .landmarks = 5, .range_m = 20.0, .most_bearings = 5});
  for (std::size_t i = 0; i < drive.images.size(); ++i)
    if (i % 10 != 5) std::erase_if(drive.images[i].bearings, [](const auto& seen) { return seen.landmark == 4; });
  const Smoother smoother = driven(drive);
  const auto poses =
      least_worth(smoother.graph(), in_order(smoother.graph()), 45, {.newest_kept = 10, .fewest_bearings = 0});
  EXPECT_EQ(poses.size(), 45U);
  EXPECT_LE(std::ranges::count_if(poses, [](PoseId id) { return id % 10 == 5; }), 1);
  // AND the path is covered evenly
  PoseId gap = 0, before = 0;
  for (PoseId id = 1; id < 90; ++id)
    if (!std::ranges::binary_search(poses, id)) {
      gap = std::max(gap, id - before);
      before = id;
    }
  EXPECT_LE(gap, 5);
}

BearingSet image_of(const NamedDrive::Image& image, double time_s) {
  BearingSet set;
  set.stamp = Stamp{} + duration_from_seconds(time_s);
  for (const auto& [landmark, azimuth_rad] : image.bearings)
    set.bearings.push_back({.azimuth_rad = azimuth_rad, .identity = landmark});
  return set;
}

TEST(KnownNames, HasNoMoreKeyframesThanItMay) {
  const NamedDrive drive = named_drive({.seed = 2, .images = 700, .sigma_rad = 0.0262});
  KnownNamesSettings settings;
  KnownNames all(settings);
  settings.max_keyframes = 100;
  KnownNames names(settings);
  double told_m2 = 0.0, all_m2 = 0.0;
  for (std::size_t i = 0; i < drive.images.size(); ++i) {
    for (KnownNames* each : {&names, &all}) {
      if (i > 0) each->predict(drive.images[i].motion);
      each->update(image_of(drive.images[i], 0.6 * static_cast<double>(i)));
    }
    if (names.is_full()) names.forget(names.least_worth());
    ASSERT_LE(names.smoother().graph().poses(), 100);
    ASSERT_EQ(names.anchor(), all.anchor());
    ASSERT_LT((names.pose().position() - drive.images[i].T_first_body.position()).norm(), 0.3) << i;
  }
  // THEN forgotten poses can still be queried, and their accuracy is only slightly lower
  for (PoseNumber number = 0; number <= names.anchor(); ++number) {
    const Eigen::Vector2d there = drive.images[static_cast<std::size_t>(number)].T_first_body.position();
    told_m2 += (names.past(number).T_map_body.position() - there).squaredNorm();
    all_m2 += (all.past(number).T_map_body.position() - there).squaredNorm();
  }
  EXPECT_LT(std::sqrt(told_m2), 2.0 * std::sqrt(all_m2));
  ASSERT_EQ(names.smoother().graph().landmarks(), all.smoother().graph().landmarks());
  for (LandmarkId id = 0; id < all.smoother().graph().landmarks(); ++id)
    EXPECT_EQ(names.sightings(id), all.sightings(id));
}

}  // namespace
}  // namespace azimuth
