#include "slam/estimator/mounted_estimator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/geometry/index.hpp"
#include "slam/planar/make_ekf_estimator.hpp"

namespace azimuth {
namespace {

const Eigen::Vector2d kMount_m(0.3, -0.1);
constexpr double kStep = 1e-6;

Eigen::Vector3d moved_by(Eigen::Vector3d vector, int entry, double by) {
  vector[entry] += by;
  return vector;
}

Pose2 pose_of(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

TEST(MountedEstimator, PosesOfAPointFollowTheirJacobian) {
  const Eigen::Vector3d body(1.2, -0.7, 2.1);
  const Eigen::Matrix3d by_body = point_pose_by_body(kMount_m, body.z());
  for (int entry = 0; entry < 3; ++entry) {
    const Eigen::Vector3d above = point_pose(kMount_m, pose_of(moved_by(body, entry, kStep))).vector(),
                          below = point_pose(kMount_m, pose_of(moved_by(body, entry, -kStep))).vector();
    EXPECT_TRUE(((above - below) / (2.0 * kStep)).isApprox(by_body.col(entry), 1e-8)) << entry;
  }
}

TEST(MountedEstimator, AMotionTakesThePointFromWhereItWasToWhereItIs) {
  Motion motion;
  motion.T_start_end = {0.4, 0.1, 0.8};
  const Pose2 start{2.0, -1.0, 0.5};
  const Pose2 end = point_pose(kMount_m, start) * point_motion(kMount_m, motion).T_start_end;
  EXPECT_TRUE(end.vector().isApprox(point_pose(kMount_m, start * motion.T_start_end).vector(), 1e-12));
}

// Noise and derivatives of the mounting point's motion are those of the body's motion, transformed to the point.
TEST(MountedEstimator, NoiseAndDerivativesOfAMotionAreThePoints) {
  Motion motion;
  motion.T_start_end = {0.4, 0.1, 0.8};
  motion.covariance = Eigen::Vector3d(1e-4, 2e-4, 3e-4).asDiagonal();
  motion.by_scales << 0.4, 0.02, 0.1, 0.03, 0.0, 0.8;
  motion.by_lag = {0.5, -0.1, 1.1};
  motion.by_drift = {-0.02, 0.2, 0.42};
  motion.velocity_at_end = {0.5, 0.1, 1.0};
  motion.path_m = 0.42;
  const Motion of_point = point_motion(kMount_m, motion);
  Eigen::Matrix3d by_body;
  for (int entry = 0; entry < 3; ++entry) {
    Motion above = motion, below = motion;
    above.T_start_end = pose_of(moved_by(motion.T_start_end.vector(), entry, kStep));
    below.T_start_end = pose_of(moved_by(motion.T_start_end.vector(), entry, -kStep));
    by_body.col(entry) =
        (point_motion(kMount_m, above).T_start_end.vector() - point_motion(kMount_m, below).T_start_end.vector()) /
        (2.0 * kStep);
  }
  EXPECT_TRUE(of_point.covariance.isApprox(by_body * motion.covariance * by_body.transpose(), 1e-8));
  EXPECT_TRUE(of_point.by_scales.isApprox(by_body * motion.by_scales, 1e-8));
  EXPECT_TRUE(of_point.by_lag.isApprox(by_body * motion.by_lag, 1e-8));
  EXPECT_TRUE(of_point.by_drift.isApprox(by_body * motion.by_drift, 1e-8));
  // v + turn rate * perp(mount)
  EXPECT_TRUE(of_point.velocity_at_end.isApprox(Eigen::Vector3d(0.5 - kMount_m.y(), 0.1 + kMount_m.x(), 1.0), 1e-12));
  EXPECT_EQ(of_point.path_m, motion.path_m);
}

TEST(MountedEstimator, IsNotThereOverTheAxle) {
  const auto plain = mounted({}, nullptr, [](const MapSnapshot*) { return make_ekf_estimator({}, {}); });
  EXPECT_EQ(dynamic_cast<const MountedEstimator*>(plain.get()), nullptr);
}

Bearing towards(const Eigen::Vector2d& p_world_m, const Pose2& T_world_body) {
  const Eigen::Vector2d p = inverse(point_pose(kMount_m, T_world_body)) * p_world_m;
  Bearing bearing;
  bearing.azimuth_rad = std::atan2(p.y(), p.x());
  return bearing;
}

/// A drive along a circle among named landmarks, with exact bearings.
class Circle : public testing::Test {
 protected:
  Circle() {
    rig_.camera.identities = true;
    rig_.camera.position_m = {kMount_m.x(), kMount_m.y()};
  }

  std::unique_ptr<Estimator> estimator(const MapSnapshot* map = nullptr) const {
    return mounted(rig_.camera, map, [&](const MapSnapshot* seen) {
      MapStart start;
      start.map = seen;
      start.pose_known = true;
      return make_ekf_estimator(rig_, {}, start);
    });
  }

  void drive(Estimator& estimator, int steps) {
    const MotionNoise noise{.lambda_distance_m = 1e-6, .lambda_rotation_rad = 1e-6};
    for (int i = 0; i < steps; ++i) {
      Motion motion;
      const Control control{.distance_m = 0.1, .first_turn_rad = 0.02, .second_turn_rad = 0.02};
      append(motion, control, control, noise);
      T_world_body_ = T_world_body_ * motion.T_start_end;
      estimator.predict(motion);
      BearingSet set;
      for (std::size_t k = 0; k < landmarks_m_.size(); ++k) {
        set.bearings.push_back(towards(landmarks_m_[k], T_world_body_));
        set.bearings.back().identity = static_cast<Identity>(k);
      }
      estimator.update(set);
    }
  }

  Rig rig_;
  Pose2 T_world_body_;
  std::vector<Eigen::Vector2d> landmarks_m_{{3.0, 4.0}, {-3.0, 2.0}, {2.0, -2.0}, {-2.0, 6.0}};
};

TEST_F(Circle, BodyAndLandmarksAreWhereTheyAreFromTheBodysFirstPose) {
  const auto estimator = this->estimator();
  drive(*estimator, 160);
  Estimate estimate;
  estimator->estimate(estimate);
  EXPECT_LT((estimate.T_map_body.vector() - T_world_body_.vector()).norm(), 0.02);
  ASSERT_EQ(estimate.landmarks.size(), landmarks_m_.size());
  for (const LandmarkEstimate& landmark : estimate.landmarks)
    EXPECT_LT((landmark.p_map_landmark_m - landmarks_m_[static_cast<std::size_t>(landmark.identity)]).norm(), 0.05);
}

TEST_F(Circle, AheadOfTheLastStepItIsTheBodyToo) {
  const auto estimator = this->estimator();
  drive(*estimator, 60);
  Motion motion;
  motion.T_start_end = {0.05, 0.0, 0.4};
  Estimate now, ahead;
  estimator->estimate(now);
  estimator->look_ahead(motion, ahead);
  EXPECT_TRUE(ahead.T_map_body.vector().isApprox((now.T_map_body * motion.T_start_end).vector(), 1e-9));
}

TEST_F(Circle, ASavedMapGoesOnWhereTheBodyWas) {
  const auto first = estimator();
  drive(*first, 160);
  MapSnapshot saved;
  ASSERT_TRUE(first->save_map(saved));
  EXPECT_LT((saved.T_map_body.vector() - T_world_body_.vector()).norm(), 0.02);
  const auto second = estimator(&saved);
  MapSnapshot again;
  drive(*second, 1);
  ASSERT_TRUE(second->save_map(again));
  EXPECT_LT((again.T_map_body.vector() - T_world_body_.vector()).norm(), 0.02);
  for (std::size_t i = 0; i < again.landmarks.size(); ++i)
    EXPECT_LT((again.landmarks[i].p_map_landmark_m - saved.landmarks[i].p_map_landmark_m).norm(), 0.02) << i;
}

TEST(MountedEstimator, AMapsPoseGoesToThePointAndBack) {
  MapSnapshot map;
  map.T_map_body = {1.0, 2.0, 0.7};
  map.landmarks.resize(2);
  map.covariance.resize(map.entries());
  Eigen::MatrixXd A(7, 7);
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) A(i, j) = std::sin(1.0 + 3.0 * i + 7.0 * j);
  const Eigen::MatrixXd P = A * A.transpose();
  for (std::size_t row = 0; row < 7; ++row)
    for (std::size_t column = 0; column <= row; ++column)
      map.covariance(row, column) = P(as_index(row), as_index(column));
  MapSnapshot moved = map;
  move_pose_to(kMount_m, moved);
  Eigen::MatrixXd by = Eigen::MatrixXd::Identity(7, 7);
  by.topLeftCorner<3, 3>() = point_pose_by_body(kMount_m, 0.7);
  const Eigen::MatrixXd expected = by * P * by.transpose();
  for (std::size_t row = 0; row < 7; ++row)
    for (std::size_t column = 0; column <= row; ++column)
      EXPECT_NEAR(moved.covariance(row, column), expected(as_index(row), as_index(column)), 1e-12);
  move_pose_to(-kMount_m, moved);
  EXPECT_TRUE(moved.T_map_body.vector().isApprox(map.T_map_body.vector(), 1e-12));
  for (std::size_t i = 0; i < map.covariance.lower().size(); ++i)
    EXPECT_NEAR(moved.covariance.lower()[i], map.covariance.lower()[i], 1e-12);
}

}  // namespace
}  // namespace azimuth
