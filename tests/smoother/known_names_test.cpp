// Conversion of images with named landmarks to poses of the graph.

#include "slam/smoother/known_names.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

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
    EXPECT_EQ(names.update(seen_at(1.0 * i, {{.azimuth_rad = 0.5, .identity = 7}})), i < 3);
  }
  EXPECT_EQ(names.smoother().graph().poses(), 1);
  EXPECT_EQ(names.smoother().graph().bearings(), 3) << "from one place no more than that";
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
  // The same two motions, now with an image that adds a pose to the graph.
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

/// Bearings from a pose to landmarks at these places, with the names 0, 1, ...
std::vector<Bearing> bearings_from(const Pose2& T_map_body, const std::vector<Eigen::Vector2d>& landmarks) {
  std::vector<Bearing> bearings;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::Vector2d p = inverse(T_map_body) * landmarks[i];
    bearings.push_back({.azimuth_rad = std::atan2(p.y(), p.x()), .identity = static_cast<Identity>(i)});
  }
  return bearings;
}

const std::vector<Eigen::Vector2d> kPlaces{{3.0, 2.0}, {-2.0, 3.0}, {4.0, -2.0}, {-3.0, -2.5}, {0.5, 4.0}};

TEST(KnownNames, ALandmarkFirstSeenUnderAnothersNameIsFoundAllTheSame) {
  KnownNames names{{}};
  Pose2 T_map_body;
  int reinitialised = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<Bearing> bearings = bearings_from(T_map_body, kPlaces);
    // The other landmark is on the opposite side of the robot.
    if (i < 2) std::swap(bearings[0].identity, bearings[3].identity);
    names.update(seen_at(i, bearings));
    reinitialised += names.last_image().reinitialised;
    const Motion motion = driven(0.15, 0.15);
    names.predict(motion);
    T_map_body = T_map_body * motion.T_start_end;
  }
  EXPECT_GT(reinitialised, 0);
  for (LandmarkId id = 0; id < names.smoother().graph().landmarks(); ++id)
    if (names.is_current(id)) {
      const Eigen::Vector2d& there = kPlaces[static_cast<std::size_t>(names.names()[static_cast<std::size_t>(id)])];
      EXPECT_LT((names.smoother().graph().landmark(id).p_map() - there).norm(), 0.1);
    }
}

TEST(KnownNames, AWrongIdeaOfDistancesIsForgottenOnceBearingsTell) {
  // GIVEN a prior that places all landmarks much nearer than they are
  KnownNamesSettings settings;
  settings.smoother.inverse_depth_mean_per_m = 1.5;
  KnownNames names{settings};
  Pose2 T_map_body;
  const auto look = [&](double stamp_s) {
    std::vector<Bearing> bearings = bearings_from(T_map_body, kPlaces);
    if (stamp_s > 0.5) bearings.erase(bearings.begin());  // landmark 0 is seen from one place only
    names.update(seen_at(stamp_s, bearings));
  };
  // WHEN the robot has seen the other landmarks from many places, without noise
  for (int i = 0; i < 40; ++i) {
    look(i);
    const Motion motion = driven(0.15, 0.15);
    names.predict(motion);
    T_map_body = T_map_body * motion.T_start_end;
  }
  look(40.0);
  names.conclude(100);
  // THEN the wrong prior no longer affects the estimate
  const BearingGraph& graph = names.smoother().graph();
  EXPECT_LT((names.pose().vector() - T_map_body.vector()).norm(), 2e-3);
  for (LandmarkId id = 0; id < graph.landmarks(); ++id) {
    const Identity name = names.names()[static_cast<std::size_t>(id)];
    EXPECT_EQ(graph.has_prior(id), name == 0) << name;
    if (name == 0) continue;
    EXPECT_LT((graph.landmark(id).p_map() - kPlaces[static_cast<std::size_t>(name)]).norm(), 5e-3) << name;
  }
}

TEST(KnownNames, ARobotPutElsewhereIsThere) {
  KnownNames names{{}};
  for (int i = 0; i < 10; ++i) {
    names.predict(driven(0.2, 0.1));
    names.update(seen_at(i, bearings_from(names.pose(), kPlaces)));
  }
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.04, 0.09, 0.01).asDiagonal();
  const Pose2 there{-1.0, 0.5, 2.0};
  names.predict(driven(1.0));
  names.place(there, covariance);
  EXPECT_LT((names.pose().vector() - there.vector()).norm(), 1e-6);
  // AND the previous knowledge of the pose reduces the covariance
  EXPECT_LT((names.covariance() - covariance).norm(), 0.3 * covariance.norm());
}

}  // namespace
}  // namespace azimuth
