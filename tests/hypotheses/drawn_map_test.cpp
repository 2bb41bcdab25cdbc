#include "slam/hypotheses/drawn_map.hpp"

#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// Settings without clutter: every bearing that fits a landmark belongs to it.
DrawnMapSettings sure_settings() {
  DrawnMapSettings settings;
  settings.hypothesis.scene.sigma_bearing_rad = 0.02;
  settings.hypothesis.scene.field_of_view_rad = std::numbers::pi / 3.0;
  settings.hypothesis.scene.detection_probability = 0.9;
  settings.hypothesis.scene.clutter_per_rad = 0.0;
  settings.hypothesis.scene.new_per_rad = 1e-9;
  return settings;
}

Motion motion_to(const Pose2& T_start_end, double sigma_m, double sigma_rad) {
  Motion motion;
  motion.T_start_end = T_start_end;
  motion.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  motion.path_m = std::hypot(T_start_end.x_m, T_start_end.y_m);
  motion.turned_rad = std::abs(T_start_end.heading_rad);
  return motion;
}

double azimuth_of(const Pose2& T, const Eigen::Vector2d& p) {
  return wrap(std::atan2(p.y() - T.y_m, p.x() - T.x_m) - T.heading_rad);
}

/// (alpha, rho) of a point in a chart.
Eigen::Vector2d in_chart(const Eigen::Vector2d& p, const Eigen::Vector2d& chart) {
  return {std::atan2(p.y() - chart.y(), p.x() - chart.x()), 1.0 / (p - chart).norm()};
}

Draws draws() { return Draws(Xoshiro(3)); }

/// A map after an uncertain turn and one bearing of one landmark.
DrawnMap with_one_landmark(const Motion& turn, double azimuth_rad, Draws& numbers) {
  DrawnMap map;
  map.move(turn);
  map.take(std::vector<NamelessSighting>{{azimuth_rad, 0.02}}, sure_settings(), 0.0, numbers);
  return map;
}

/// The position of a landmark relative to the robot, in coordinates that do not change when the whole map moves.
/// stepped() applies a step of these coordinates in the same way as the map.
struct Place {
  Pose2 pose;
  SmoothedLandmark landmark;
  Place stepped(const Eigen::Matrix<double, 5, 1>& step) const {
    const Eigen::Vector2d to = pose.position() + step.head<2>();
    const double c = std::cos(step(2)), s = std::sin(step(2));
    const Eigen::Matrix2d turn{{c, -s}, {s, c}};
    return {{to.x(), to.y(), pose.heading_rad + step(2)},
            {to + turn * (landmark.p_map_chart - pose.position()), landmark.direction_rad + step(2) + step(3),
             landmark.inverse_distance_per_m + step(4)}};
  }
};

TEST(DrawnMap, ANewLandmarkLiesToTheRobotAsWhatWasMeasured) {
  Draws numbers = draws();
  const DrawnMap map = with_one_landmark(motion_to({1.0, 0.3, 0.7}, 0.1, 0.05), 0.2, numbers);
  ASSERT_EQ(map.landmarks(), 1U);
  EXPECT_EQ((map.covariance().block<2, 3>(3, 0)), (Eigen::Matrix<double, 2, 3>::Zero()));
  EXPECT_NEAR(map.covariance()(3, 3), 0.02 * 0.02, 1e-15);
  EXPECT_NEAR(map.covariance()(4, 4), 0.25 * 0.25, 1e-15);
  EXPECT_NEAR(map.landmark(0).direction_rad, 0.9, 1e-12);
  EXPECT_EQ(map.landmark(0).p_map_chart, map.pose().position());
}

/// The effect of motion noise on the landmark's position relative to the robot.
TEST(DrawnMap, MotionMovesTheRobotAndNotTheLandmarks) {
  const DrawnMapSettings settings = sure_settings();
  DrawnMap map;
  Draws numbers = draws();
  map.take(std::vector<NamelessSighting>{{0.3, 0.02}}, settings, 0.0, numbers);
  const Eigen::MatrixXd before = map.covariance();
  const Motion motion = motion_to({0.6, 0.2, 0.3}, 0.05, 0.04);
  const MovedPose moved = apply(map.pose(), motion);
  map.move(motion);
  const Place place{map.pose(), map.landmark(0)};
  Eigen::Matrix<double, 5, 3> by_noise;
  for (int i = 0; i < 3; ++i) {
    // The step moves everything. A further step of the landmark moves it back to its place.
    const auto of_all = [&](double step) {
      const Place all = place.stepped(step * Eigen::Matrix<double, 5, 1>::Unit(i));
      return in_chart(all.landmark.p_map(), place.landmark.p_map_chart);
    };
    by_noise.col(i) << Eigen::Vector3d::Unit(i), -(of_all(1e-6) - of_all(-1e-6)) / 2e-6;
  }
  Eigen::MatrixXd expected = before;
  expected.topLeftCorner<3, 3>().setZero();  // the pose was certain
  expected += by_noise * moved.noise * by_noise.transpose();
  EXPECT_LT((map.covariance() - expected).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(DrawnMap, ABearingCorrectsEverythingAsAKalmanFilterWould) {
  const DrawnMapSettings settings = sure_settings();
  Draws numbers = draws();
  DrawnMap map = with_one_landmark(motion_to({0.0, 0.0, 0.1}, 0.05, 0.03), 0.3, numbers);
  map.move(motion_to({0.6, 0.0, 0.05}, 0.03, 0.02));
  const Place before{map.pose(), map.landmark(0)};
  const Eigen::MatrixXd P = map.covariance();
  const auto predicted = [&](const Eigen::Matrix<double, 5, 1>& step) {
    const Place place = before.stepped(step);
    return azimuth_of(place.pose, place.landmark.p_map());
  };
  const double z_rad = predicted(Eigen::Matrix<double, 5, 1>::Zero()) + 0.04;
  map.take(std::vector<NamelessSighting>{{z_rad, 0.02}}, settings, 0.5, numbers);
  ASSERT_EQ(map.landmarks(), 1U);

  Eigen::Matrix<double, 5, 1> H;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix<double, 5, 1> step = 1e-6 * Eigen::Matrix<double, 5, 1>::Unit(i);
    H(i) = wrap(predicted(step) - predicted(-step)) / 2e-6;
  }
  EXPECT_LT(H.head<3>().norm(), 1e-8) << "moving all is not seen";
  const double S = H.dot(P * H) + 0.02 * 0.02;
  const Eigen::Matrix<double, 5, 1> K = P * H / S;
  const Place after = before.stepped(0.04 * K);
  EXPECT_LT((map.pose().vector() - after.pose.vector()).norm(), 1e-8);
  EXPECT_LT((map.landmark(0).p_map() - after.landmark.p_map()).norm(), 1e-7);
  EXPECT_LT((map.covariance() - (P - S * K * K.transpose())).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((map.covariance() - map.covariance().transpose()).cwiseAbs().maxCoeff(), 1e-15);
}

/// However often new landmarks are seen, they give no information on the robot's pose in the map.
TEST(DrawnMap, NewLandmarksSayNothingOfThePose) {
  const DrawnMapSettings settings = sure_settings();
  DrawnMap map;
  map.move(motion_to({0.0, 0.0, 0.0}, 0.4, 0.2));
  Draws numbers = draws();
  const std::vector<Eigen::Vector2d> landmarks{{2.6, 0.9}, {2.8, -0.8}, {3.4, 0.3}};
  Pose2 truth;
  const Motion motion = motion_to({0.15, 0.0, 0.0}, 0.0, 0.0);
  for (int step = 0; step < 10; ++step) {
    std::vector<NamelessSighting> seen;
    for (const Eigen::Vector2d& landmark : landmarks) seen.push_back({azimuth_of(truth, landmark), 0.01});
    map.take(seen, settings, 0.4 * step, numbers);
    truth = truth * motion.T_start_end;
    map.move(motion);
  }
  EXPECT_EQ(map.landmarks(), 3U);
  EXPECT_NEAR(map.covariance()(2, 2), 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(map.covariance()(0, 0), 0.4 * 0.4, 1e-9);
}

TEST(DrawnMap, WhatIsSeenTooLittleIsForgotten) {
  const DrawnMapSettings settings = sure_settings();
  DrawnMap map;
  Draws numbers = draws();
  map.take(std::vector<NamelessSighting>{{0.3, 0.02}, {-0.3, 0.02}}, settings, 0.0, numbers);
  for (const double now_s : {0.5, 1.0, 1.5})
    map.take(std::vector<NamelessSighting>{{0.3, 0.02}}, settings, now_s, numbers);
  EXPECT_EQ(map.landmarks(), 2U);
  map.take({}, settings, 3.1, numbers);
  EXPECT_EQ(map.landmarks(), 1U);
  map.take({}, settings, 60.0, numbers);
  EXPECT_EQ(map.landmarks(), 1U) << "seen four times, it stays";
}

TEST(DrawnMap, HasSoManyLandmarksAtMost) {
  DrawnMapSettings settings = sure_settings();
  settings.most_landmarks = 5;
  DrawnMap map;
  Draws numbers = draws();
  double now_s = 0.0;
  for (int place = 0; place < 12; ++place) {
    map.move(motion_to({3.0, 0.0, 0.4}, 0.01, 0.01));
    for (int image = 0; image < 4; ++image, now_s += 0.5)
      map.take(std::vector<NamelessSighting>{{0.0, 0.02}}, settings, now_s, numbers);
    EXPECT_LE(map.landmarks(), 5U);
  }
  EXPECT_EQ(map.landmarks(), 5U);
  EXPECT_EQ(map.covariance().rows(), 13);
}

/// A landmark with a vague prediction that was not seen for long is not matched.
TEST(DrawnMap, AVaguePredictionClosesNoLoop) {
  DrawnMapSettings settings = sure_settings();
  DrawnMap map;
  Draws numbers = draws();
  for (int image = 0; image < 5; ++image)
    map.take(std::vector<NamelessSighting>{{0.1, 0.02}}, settings, 0.5 * image, numbers);
  DrawnMap sharp = map;
  sharp.move(motion_to({0.0, 0.0, 0.0}, 0.01, 0.1));
  map.move(motion_to({0.0, 0.0, 0.0}, 0.01, 0.3));
  for (DrawnMap* each : {&sharp, &map}) each->take(std::vector<NamelessSighting>{{0.1, 0.02}}, settings, 30.0, numbers);
  EXPECT_EQ(sharp.landmarks(), 1U);
  EXPECT_EQ(map.landmarks(), 2U);
}

TEST(DrawnMap, ThingsOfTwoKindsAreNeverTheSame) {
  const DrawnMapSettings settings = sure_settings();
  DrawnMap map;
  Draws numbers = draws();
  map.take(std::vector<NamelessSighting>{{0.1, 0.02, 1}}, settings, 0.0, numbers);
  map.take(std::vector<NamelessSighting>{{0.1, 0.02, 2}}, settings, 0.5, numbers);
  EXPECT_EQ(map.landmarks(), 2U);
  map.take(std::vector<NamelessSighting>{{0.1, 0.02, 2}}, settings, 1.0, numbers);
  EXPECT_EQ(map.landmarks(), 2U);
}

}  // namespace
}  // namespace azimuth
