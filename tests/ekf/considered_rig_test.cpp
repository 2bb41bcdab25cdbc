// Considered rig constants in the filters. Covers the effect of the odometer's scale errors on path and map, and that
// no bearing corrects a scale error.

#include <cmath>
#include <gtest/gtest.h>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kSigmaScale = 0.01;
constexpr double kDrivenStep_m = 0.1;

/// A motion without noise, so that all uncertainty of the pose comes from the scales.
Motion exactly(const Control& control) {
  Motion motion;
  append(motion, control, control, {});
  return motion;
}

BearingEkfSettings with_scales(const Eigen::Vector2d& sigma) {
  BearingEkfSettings settings;
  settings.sigma_considered.head<2>() = sigma;
  settings.charge_curvature = true;
  return settings;
}

template <class Filter>
void drive(Filter& filter, double distance_m) {
  for (int i = 0; i < static_cast<int>(std::lround(distance_m / kDrivenStep_m)); ++i)
    filter.predict(exactly({.distance_m = kDrivenStep_m}));
}

/// The covariance of the pose, including the part of the considered constants.
Eigen::Matrix3d total(const JointState& state) {
  return state.pose_covariance() + covariance_by_considered<3>(state, JointState::kPose);
}
double sigma_x_m(const JointState& state) { return std::sqrt(total(state)(0, 0)); }

template <class Filter>
void expect_growth_with_distance_and_none_on_return(Filter& filter) {
  drive(filter, 10.0);
  EXPECT_NEAR(sigma_x_m(filter.state()), kSigmaScale * 10.0, 1e-9);
  EXPECT_NEAR(total(filter.state())(1, 1), 0.0, 1e-15) << "across the way";
  filter.predict(exactly({.second_turn_rad = kPi}));
  drive(filter, 10.0);
  EXPECT_NEAR(sigma_x_m(filter.state()), 0.0, 1e-7) << "both ways are too long by the same";
}

TEST(OdometerScales, OfDistanceGrowWithTheDistanceFromTheStartAndAreGoneOnReturn) {
  BearingEkf flat(with_scales({kSigmaScale, 0.0}));
  expect_growth_with_distance_and_none_on_return(flat);
  LampEkfModel model;
  model.sigma_considered(considered::scale_distance) = kSigmaScale;
  LampEkf lamps(model);
  expect_growth_with_distance_and_none_on_return(lamps);
}

TEST(OdometerScales, OfTurnsGrowWithTheTurnAndAreUndoneBackwards) {
  BearingEkf ekf(with_scales({0.0, kSigmaScale}));
  ekf.predict(exactly({.second_turn_rad = 2.0}));
  EXPECT_NEAR(std::sqrt(total(ekf.state())(2, 2)), 2.0 * kSigmaScale, 1e-9);
  ekf.predict(exactly({.second_turn_rad = -2.0}));
  EXPECT_NEAR(total(ekf.state())(2, 2), 0.0, 1e-12);
}

/// 20 m with precise bearings all round: they determine the path up to its scale.
TEST(OdometerScales, NoBearingTellsThatOfDistance) {
  BearingEkf ekf(with_scales({kSigmaScale, kSigmaScale}));
  RandomDraws draws(1);
  std::vector<Eigen::Vector2d> landmarks;
  std::vector<Index> rays;
  constexpr double kSigma_rad = 0.005;
  for (int i = 0; i < 16; ++i) {
    landmarks.emplace_back(draws.uniform(-5.0, 25.0), (i % 2 == 0 ? 1.0 : -1.0) * draws.uniform(2.0, 6.0));
    rays.push_back(ekf.add_ray(std::atan2(landmarks.back().y(), landmarks.back().x()), kSigma_rad, 0.25, 0.25));
  }
  Motion step = exactly({.distance_m = kDrivenStep_m});
  step.covariance = Eigen::Vector3d(1e-5, 1e-6, 1e-6).asDiagonal();
  for (int k = 1; k <= 200; ++k) {
    ekf.predict(step);
    std::vector<MappedSighting> sightings;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector2d d = landmarks[i] - Eigen::Vector2d(k * kDrivenStep_m, 0.0);
      sightings.push_back({JointState::kPose, rays[i], BlockKind::inverse_depth,
                           std::atan2(d.y(), d.x()) + draws.normal(kSigma_rad), kSigma_rad * kSigma_rad});
    }
    ASSERT_TRUE(ekf.update(sightings));
  }
  const double within_m2 = ekf.state().covariance(0, 0), by_scale_m = kSigmaScale * 20.0;
  EXPECT_LE(within_m2, 200 * 1e-5);
  EXPECT_NEAR(sigma_x_m(ekf.state()), std::sqrt(within_m2 + by_scale_m * by_scale_m), 0.1 * by_scale_m);
  // The map has the same relative error as the path.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Eigen::Matrix<double, 2, 4> J;
    const Eigen::Vector2d p = point_of(ekf.ray(rays[i]), &J);
    const Eigen::Matrix2d expected = kSigmaScale * kSigmaScale * p * p.transpose();
    if (p.norm() > 10.0) continue;  // hardly any parallax
    EXPECT_LT((covariance_by_considered(ekf.state(), rays[i], J) - expected).norm(), 0.3 * expected.norm()) << i;
  }
}

/// Considered constants change the covariance of the errors, but not the estimate.
TEST(OdometerScales, LeaveTheEstimateAlone) {
  BearingEkf with(with_scales({kSigmaScale, kSigmaScale})), without(with_scales({0.0, 0.0}));
  for (BearingEkf* ekf : {&with, &without}) {
    const Index ray = ekf->add_ray(0.5, 0.01, 0.25, 0.25);
    drive(*ekf, 1.0);
    ASSERT_TRUE(
        ekf->update(std::vector<MappedSighting>{{JointState::kPose, ray, BlockKind::inverse_depth, 0.7, 1e-4}}));
  }
  for (Index i = 0; i < with.state().extent(); ++i) {
    EXPECT_EQ(with.state().mean(i), without.state().mean(i));
    for (Index k = 0; k <= i; ++k) EXPECT_EQ(with.state().covariance(i, k), without.state().covariance(i, k));
  }
}

/// A loaded map was made with the same odometer, so it shares the scale errors.
TEST(OdometerScales, AreThoseOfTheMapThatIsLoaded) {
  MapSnapshot map;
  map.T_map_body = {3.0, 4.0, 1.0};
  map.landmarks.push_back({.id = 0, .p_map_landmark_m = {6.0, -2.0}});
  map.covariance.resize(map.entries());
  BearingEkf ekf(with_scales({kSigmaScale, kSigmaScale}));
  const Index block = ekf.restore(map).front();
  const Eigen::Vector2d p(6.0, -2.0);
  EXPECT_LT((covariance_by_considered<2>(ekf.state(), block) - kSigmaScale * kSigmaScale * p * p.transpose()).norm(),
            1e-12);
  EXPECT_NEAR(sigma_x_m(ekf.state()), 0.03, 1e-12);
}

TEST(ConsideredRig, DerivativesOfAMotionOfManySegments) {
  RandomDraws draws(2);
  for (int i = 0; i < 100; ++i) {
    std::vector<Control> controls;
    for (int k = 0; k < 10; ++k) controls.push_back(draws.control(1.0, 0.8));
    const auto end = [&](const Eigen::VectorXd& errors) {
      Pose2 pose;
      for (const Control& control : controls) {
        const double more_rad =
            0.5 * (errors(1) * wrap(control.first_turn_rad + control.second_turn_rad) + errors(2) * control.distance_m);
        pose = move(pose, {(1.0 + errors(0)) * control.distance_m, control.first_turn_rad + more_rad,
                           control.second_turn_rad + more_rad});
      }
      return Eigen::VectorXd(pose.vector());
    };
    Motion motion;
    for (const Control& control : controls) append(motion, control, control, {});
    Eigen::Matrix3d by_errors;
    by_errors << motion.by_scales, motion.by_drift;
    EXPECT_LT(largest_difference(by_errors, numeric_jacobian(end, Eigen::Vector3d::Zero(), {2})), kJacobianTolerance);
  }
}

/// The pose of a vector (x, y, heading).
Pose2 pose_by(const Eigen::VectorXd& v) { return {v(0), v(1), v(2)}; }

/// The mounting error e moves the camera's pose to T_map_camera * e^-1 * motion * e.
TEST(ConsideredRig, DerivativesOfAMotionByTheMounting) {
  RandomDraws draws(3);
  for (int i = 0; i < 100; ++i) {
    const Pose2 T_map_camera = draws.pose(3.0);
    const Motion motion = exactly(draws.control(1.0, 0.8));
    const auto end = [&](const Eigen::VectorXd& e) {
      const Pose2 mounting = pose_by(e);
      return Eigen::VectorXd((T_map_camera * inverse(mounting) * motion.T_start_end * mounting).vector());
    };
    const JointState::ByConsidered B = by_considered(T_map_camera, apply(T_map_camera, motion));
    Eigen::Matrix3d by_mounting;
    by_mounting << B.middleCols<2>(considered::camera), B.col(considered::yaw);
    EXPECT_LT(largest_difference(by_mounting, numeric_jacobian(end, Eigen::Vector3d::Zero(), {2})), kJacobianTolerance);
  }
}

TEST(ConsideredRig, WhatIsAllowedForMovesARobotByItsDerivatives) {
  RandomDraws draws(5);
  for (int i = 0; i < 100; ++i) {
    const Pose2 T_map_camera = draws.pose(3.0);
    Motion motion = exactly(draws.control(1.0, 0.8));
    motion.by_lag = 0.3 * draws.normals(3);
    const auto end = [&](const Eigen::VectorXd& errors) {
      return Eigen::VectorXd(apply(T_map_camera, allowing_for(errors, motion)).T_map_body.vector());
    };
    EXPECT_LT(largest_difference(by_considered(T_map_camera, apply(T_map_camera, motion)),
                                 numeric_jacobian(end, Considered::Zero(), {2})),
              kJacobianTolerance);
  }
}

/// While nothing is seen, an error of the camera's mounting must not move the body, wherever the robot drives.
TEST(ConsideredRig, IsNoneOfTheBodysWhileNothingIsSeen) {
  BearingEkf ekf(with_scales({0.0, 0.0}));
  RandomDraws draws(4);
  for (int i = 0; i < 20; ++i) {
    const Pose2 T = ekf.state().pose();
    for (const Index entry : {0, 1, 2}) {
      Considered of_body = Considered::Zero();
      if (entry == 2) of_body(considered::yaw) = 1.0;
      if (entry < 2) of_body.segment<2>(considered::camera) = rotation(T.heading_rad).row(entry).transpose();
      EXPECT_LT((ekf.state().by_considered(entry).tail<3>() - of_body.tail<3>().transpose()).norm(), 1e-12);
    }
    ekf.predict(exactly(draws.control(0.5, 0.8)));
  }
}

}  // namespace
}  // namespace azimuth
