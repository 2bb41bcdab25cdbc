// How images of named landmarks become poses of the graph.

#include "slam/smoother/known_names.hpp"

#include <gtest/gtest.h>

#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

BearingSet seen_at(double time_s, std::vector<Bearing> bearings) {
  BearingSet set;
  set.stamp = Stamp{} + duration_from_seconds(time_s);
  set.bearings = std::move(bearings);
  return set;
}

Motion driven(double x_m, double turn_rad = 0.0) {
  Motion motion;
  append(motion, {x_m, 0.5 * turn_rad, 0.5 * turn_rad}, {x_m, 0.5 * turn_rad, 0.5 * turn_rad}, {1e-3, 1e-3, 1e-3, 0.0});
  return motion;
}

TEST(KnownNames, OneBearingOfALandmarkInHalfASecond) {
  KnownNames names{{}};
  EXPECT_TRUE(names.update(seen_at(0.0, {{.azimuth_rad = 0.5, .identity = 7}, {.azimuth_rad = 0.6, .identity = 7}})));
  names.predict(driven(0.1));
  EXPECT_FALSE(names.update(seen_at(0.4, {{.azimuth_rad = 0.51, .identity = 7}})));
  names.predict(driven(0.1));
  EXPECT_TRUE(names.update(seen_at(0.5, {{.azimuth_rad = 0.52, .identity = 7}})));
  EXPECT_EQ(names.smoother().graph().bearings(), 2);
  EXPECT_EQ(names.smoother().graph().landmarks(), 1);
  EXPECT_EQ(names.smoother().graph().poses(), 2);
}

TEST(KnownNames, WhatHasNoNameIsPassedOver) {
  KnownNames names{{}};
  EXPECT_FALSE(names.update(seen_at(0.0, {{.azimuth_rad = 0.5}})));
  EXPECT_EQ(names.smoother().graph().bearings(), 0);
}

TEST(KnownNames, ARobotThatStandsHasOnePose) {
  KnownNames names{{}};
  for (int i = 0; i < 5; ++i) {
    names.predict(Motion{});
    EXPECT_TRUE(names.update(seen_at(1.0 * i, {{.azimuth_rad = 0.5, .identity = 7}})));
  }
  EXPECT_EQ(names.smoother().graph().poses(), 1);
  EXPECT_EQ(names.smoother().graph().bearings(), 5);
}

TEST(KnownNames, BetweenPosesTheCovarianceGrowsWithTheMotion) {
  KnownNames names{{}};
  names.update(seen_at(0.0, {{.azimuth_rad = 0.5, .identity = 7}}));
  EXPECT_EQ(names.covariance(), Eigen::Matrix3d::Zero());
  names.predict(driven(0.5, 0.2));
  names.update(seen_at(0.5, {}));
  const double before = names.covariance().trace();
  names.predict(driven(0.5, 0.2));
  names.update(seen_at(1.0, {}));
  EXPECT_GT(before, 0.0);
  EXPECT_GT(names.covariance().trace(), before);
  const Pose2 expected = driven(0.5, 0.2).T_start_end * driven(0.5, 0.2).T_start_end;
  EXPECT_LT((names.pose().vector() - expected.vector()).norm(), 1e-12);
  EXPECT_EQ(names.anchor(), 0);
  // The same two motions, when an image makes a pose of them.
  const Eigen::Matrix3d in_between = names.covariance();
  names.predict(Motion{});
  EXPECT_TRUE(names.update(seen_at(1.0, {{.azimuth_rad = 1.0, .identity = 8}})));
  EXPECT_EQ(names.anchor(), 1);
  EXPECT_LT((names.covariance() - in_between).norm(), 1e-9);
}

TEST(KnownNames, ATurnOnTheSpotBeforeTheFirstImageIsAMotion) {
  KnownNames names{{}};
  names.predict(driven(0.0, 0.3));
  EXPECT_TRUE(names.update(seen_at(3.0, {{.azimuth_rad = 0.5, .identity = 7}})));
  EXPECT_NEAR(names.pose().heading_rad, 0.3, 1e-9);
  EXPECT_GT(names.covariance()(2, 2), 1e-4);
}

TEST(KnownNames, SameCallsSameBits) {
  const NamedDrive drive = named_drive({.images = 60});
  const auto run = [&] {
    KnownNames names{{}};
    for (std::size_t i = 0; i < drive.images.size(); ++i) {
      if (i > 0) names.predict(drive.images[i].motion);
      std::vector<Bearing> bearings;
      for (const auto& [landmark, azimuth_rad] : drive.images[i].bearings)
        bearings.push_back({.azimuth_rad = azimuth_rad, .identity = landmark});
      names.update(seen_at(0.3 * static_cast<double>(i), bearings));
    }
    return std::pair{names.pose(), names.covariance()};
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace azimuth
