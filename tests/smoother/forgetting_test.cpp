// Marginalising poses of a graph: the remaining graph is solved as before, and the past path stays known.

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "slam/smoother/smoother.hpp"
#include "slam/smoother/thinned_path.hpp"
#include "tests/support/batch_solution.hpp"
#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

Motion driven_noisily(double x_m, double turn_rad, double sigma = 0.01) {
  Motion motion;
  const Control control{x_m, 0.4 * turn_rad, 0.6 * turn_rad};
  append(motion, control, control, {1e-3, 1e-3, 1e-3, 0.0});
  motion.covariance.diagonal().array() += sigma * sigma;
  return motion;
}

TEST(Forgetting, OdometryPastAPoseIsThatOfBothWaysAtOnce) {
  const Motion first = driven_noisily(0.7, 0.4), second = driven_noisily(0.5, -0.9);
  Motion both = first;
  append(both, second);
  const OdometryMeasurement whole = composed(odometry_measurement(first), odometry_measurement(second));
  EXPECT_LT((whole.relative - both.T_start_end.vector()).norm(), 1e-12);
  EXPECT_LT((whole.covariance() - both.covariance).norm(), 1e-12);
  EXPECT_LT((whole.by_calibration.leftCols<2>() - both.by_scales).norm(), 1e-12);
}

TEST(Forgetting, DerivativeByTheFirstWay) {
  const OdometryMeasurement second = odometry_measurement(driven_noisily(0.5, -0.9));
  OdometryMeasurement first = odometry_measurement(driven_noisily(0.7, 0.4));
  const Eigen::Vector3d whole = composed(first, second).relative;
  const Eigen::Matrix3d G = by_first(first.relative, whole);
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < 3; ++i) {
    OdometryMeasurement moved = first;
    moved.relative[i] += kStep;
    EXPECT_LT(((composed(moved, second).relative - whole) / kStep - G.col(i)).norm(), 1e-5) << i;
  }
}

SmootherSettings solved_to_the_end() {
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  settings.calibration = {.sigma_scale_turn = 0.05, .sigma_camera_yaw_rad = 0.05};
  return settings;
}

std::vector<PoseId> every_third_old_one(const BearingGraph& graph) {
  std::vector<PoseId> poses;
  for (PoseId id = 1; id + 20 < graph.poses(); ++id)
    if (id % 3 != 0) poses.push_back(id);
  return poses;
}

TEST(Forgetting, WhatIsLeftIsSolvedAsABatch) {
  const SmootherSettings settings = solved_to_the_end();
  const NamedDrive drive = named_drive({.seed = 3, .images = 200, .scale_turn = 1.02, .camera_yaw_rad = 0.03});
  Smoother smoother(settings);
  DriveFeeder feeder(drive);
  for (int image = 1; !feeder.done(); ++image) {
    feeder.feed(smoother);
    if (image % 50 == 0) {
      const std::vector<PoseId> poses = every_third_old_one(smoother.graph());
      const std::int32_t before = smoother.graph().poses();
      smoother.forget(poses);
      ASSERT_EQ(smoother.graph().poses() + static_cast<std::int32_t>(poses.size()), before);
    }
    smoother.optimise(4);
  }
  smoother.optimise(200);
  BatchProblem batch(smoother.graph(), settings);
  ASSERT_GT(batch.solve(), 0);
  EXPECT_LT(largest_difference(batch.values(), smoother.graph().values()), 1e-6);
  EXPECT_NEAR(batch.energy(), smoother.energy(), 1e-7 * (1.0 + batch.energy()));
  // AND bearings belong to the right landmarks and poses
  for (LandmarkId landmark = 0; landmark < smoother.graph().landmarks(); ++landmark)
    for (const BearingId id : smoother.graph().bearings_of(landmark)) {
      EXPECT_EQ(smoother.graph().landmark_of(id), landmark);
      const PoseId pose = smoother.graph().bearing(id).pose;
      EXPECT_LE(smoother.graph().first_bearing_of(pose), id);
      EXPECT_GT(smoother.graph().first_bearing_of(pose + 1), id);
    }
}

TEST(Forgetting, ACopyKeepsWhatTheOtherForgets) {
  const NamedDrive drive = named_drive({.images = 80});
  Smoother smoother{SmootherSettings{}};
  for (DriveFeeder feeder(drive); !feeder.done();) feeder.feed(smoother);
  smoother.optimise(20);
  const BearingGraph::Values values = smoother.graph().values();
  const Eigen::Matrix3d covariance = smoother.newest_covariance();
  Smoother copy = smoother;
  copy.forget(every_third_old_one(copy.graph()));
  copy.optimise(20);
  EXPECT_EQ(smoother.graph().poses(), 80);
  EXPECT_EQ(largest_difference(smoother.graph().values(), values), 0.0);
  EXPECT_EQ(smoother.newest_covariance(), covariance);
  EXPECT_GT(copy.newest_covariance()(2, 2), covariance(2, 2)) << "less is known";
}

/// A drive in which only every third pose has bearings, with the estimates of all poses before marginalisation.
struct HalfBlind {
  static constexpr PoseId kPoses = 31;
  Smoother smoother{[] {
    SmootherSettings settings = solved_to_the_end();
    settings.calibration = {};
    return settings;
  }()};
  ThinnedPath path;
  std::vector<ThinnedPath::Told> before;

  HalfBlind() {
    const std::vector<Eigen::Vector2d> places{{3.0, 2.0}, {-2.0, 4.0}, {4.0, -2.0}, {1.0, 6.0}};
    std::vector<LandmarkId> landmarks(places.size(), kOfNothing);
    Pose2 T_map_body;
    for (PoseId id = 0; id < kPoses; ++id) {
      if (id > 0) {
        smoother.add_pose(driven_noisily(0.3, 0.15));
        path.add_pose();
        T_map_body = move(T_map_body, {0.305, 0.06, 0.0905});
      }
      if (id % 3 != 0) continue;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Eigen::Vector2d p = inverse(T_map_body) * places[i];
        const BearingId bearing = smoother.add_bearing(std::atan2(p.y(), p.x()), 0.02);
        if (landmarks[i] == kOfNothing)
          landmarks[i] = smoother.add_landmark(bearing);
        else
          smoother.assign(bearing, landmarks[i]);
      }
    }
    smoother.optimise(100);
    for (PoseId id = 0; id < kPoses; ++id) before.push_back(path.tell(id, smoother));
  }

  void forget(const std::vector<PoseId>& poses) {
    path.forget(smoother.graph(), poses);
    smoother.forget(poses);
    smoother.optimise(100);
  }
};

TEST(ThinnedPath, PosesThatSawNothingAreToldAsBefore) {
  HalfBlind drive;
  drive.forget({1, 4, 5, 7, 8, 10, 14, 16, 17, 19, 22, 26});
  // Two rounds: the second forgets poses to which those of the first refer.
  std::vector<PoseId> rest;
  for (PoseId id = 1; id + 1 < drive.smoother.graph().poses(); ++id)
    if (drive.path.numbers()[static_cast<std::size_t>(id)] % 3 != 0) rest.push_back(id);
  drive.forget(rest);
  ASSERT_EQ(drive.smoother.graph().poses(), HalfBlind::kPoses / 3 + 1);
  for (PoseNumber number = 0; number < HalfBlind::kPoses; ++number) {
    const ThinnedPath::Told now = drive.path.tell(number, drive.smoother);
    const ThinnedPath::Told& before = drive.before[static_cast<std::size_t>(number)];
    EXPECT_LT((now.T_map_body.vector() - before.T_map_body.vector()).norm(), 5e-4) << number;
    EXPECT_LT((now.covariance - before.covariance).norm(), 0.02 * before.covariance.norm() + 1e-9) << number;
  }
}

TEST(ThinnedPath, PosesAtTheEndsOfAWayAreThoseOfTheGraph) {
  HalfBlind drive;
  drive.forget({1, 2, 4, 5});
  EXPECT_EQ(drive.path.newest(), HalfBlind::kPoses - 1);
  const ThinnedPath::Told third = drive.path.tell(3, drive.smoother);
  EXPECT_EQ(third.T_map_body, drive.smoother.graph().pose(1));
  EXPECT_EQ(third.covariance, drive.smoother.pose_covariance(1));
}

}  // namespace
}  // namespace azimuth
