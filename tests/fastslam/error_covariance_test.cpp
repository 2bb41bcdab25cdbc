// The joint error covariance of a particle, compared with errors that are drawn and propagated one by one.

#include "slam/fastslam/error_covariance.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/ray_fit.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kEyeHeight_m = 1.8;
constexpr std::size_t kThreeLamps = 3;
const Eigen::Vector2d kSigmaScales(0.02, 0.03);
const Symmetric2 kNoiseOfSighting{4e-4, 1e-5, 1e-4};

Motion a_motion() {
  const Control control{0.4, 0.0, 0.2};
  Motion motion;
  append(motion, control, control, {.lambda_distance_m = 1e-3, .lambda_rotation_rad = 2e-3});
  return motion;
}

Eigen::Vector3d drawn(const Eigen::Matrix3d& covariance, RandomDraws& draws) {
  return semidefinite_factor(Symmetric3::of(covariance)) *
         Eigen::Vector3d(draws.normal(), draws.normal(), draws.normal());
}

Eigen::Vector2d drawn(const Symmetric2& covariance, RandomDraws& draws) {
  const Symmetric3 in_space{covariance.xx, covariance.xy, 0.0, covariance.yy, 0.0, 0.0};
  return drawn(in_space.matrix(), draws).head<2>();
}

/// The steps of a particle along a fixed path: the pose, the views of the lamps and the gains of each step.
class Steps {
 public:
  static constexpr int kCount = 4;

  explicit Steps(const std::function<void(const Steps&)>& each) {
    for (std::size_t i = 0; i < kThreeLamps; ++i) {
      p_map[i] = Eigen::Vector3d(2.0 - 1.5 * static_cast<double>(i), 1.0 + static_cast<double>(i), 6.0);
      Sigma[i] = {0.04, 0.01, 0.0, 0.05, 0.01, 0.03};
    }
    for (step = 0; step < kCount; ++step) {
      moved = apply(pose, a_motion());
      pose = moved.T_map_body;
      PoseProposal proposed(pose.vector(), Symmetric3::of(moved.noise));
      for (std::size_t i = 0; i < kThreeLamps; ++i) {
        views[i] = view(Viewpoint(pose, kEyeHeight_m), p_map[i]);
        proposed.add(views[i], Eigen::Vector2d::Zero(), views[i].of_point(Sigma[i]) + kNoiseOfSighting);
      }
      proposal = proposed.covariance();
      each(*this);
      const Viewpoint from(pose, kEyeHeight_m);
      for (std::size_t i = 0; i < kThreeLamps; ++i) {
        const Eigen::Vector2d z = direction_of(views[i], from.heading_rad);
        correct(from, make_sighting(z.x(), z.y(), kNoiseOfSighting), p_map[i], Sigma[i]);
      }
    }
  }

  int step = 0;
  Pose2 pose{0.3, -0.2, 0.5};
  MovedPose moved;
  Symmetric3 proposal;
  std::array<LampView, kThreeLamps> views;
  std::array<Eigen::Vector3d, kThreeLamps> p_map;
  std::array<Symmetric3, kThreeLamps> Sigma;
};

/// The errors of one drawn particle.
struct Drawn {
  Eigen::Vector3d e_x = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, kThreeLamps> e_m;
  Eigen::Vector2d e_scales;
};

/// Propagates the errors through one step: one landmark after the other as in algorithm 3, then algorithm 4.
void go(Drawn& error, const Steps& steps, RandomDraws& draws) {
  error.e_x = steps.moved.G * error.e_x + steps.moved.by_scales * error.e_scales + drawn(steps.moved.noise, draws);
  std::array<Eigen::Vector2d, kThreeLamps> v;
  Eigen::Matrix3d P = steps.moved.noise;
  for (std::size_t i = 0; i < kThreeLamps; ++i) {
    v[i] = drawn(kNoiseOfSighting, draws);
    const Eigen::Matrix<double, 2, 3> H_x = steps.views[i].H_x(), H_m = steps.views[i].H_m();
    const Eigen::Matrix2d S =
        H_x * P * H_x.transpose() + (steps.views[i].of_point(steps.Sigma[i]) + kNoiseOfSighting).matrix();
    const Eigen::Matrix<double, 3, 2> K = P * H_x.transpose() * S.inverse();
    error.e_x += K * (v[i] - H_x * error.e_x - H_m * error.e_m[i]);
    P -= K * S * K.transpose();
  }
  error.e_x += drawn(P, draws);
  for (std::size_t i = 0; i < kThreeLamps; ++i) {
    const Eigen::Matrix<double, 2, 3> H_m = steps.views[i].H_m();
    const Eigen::Matrix2d Q = (steps.views[i].of_point(steps.Sigma[i]) + kNoiseOfSighting).matrix();
    const Eigen::Matrix<double, 3, 2> K = steps.Sigma[i].matrix() * H_m.transpose() * Q.inverse();
    error.e_m[i] += K * (v[i] - steps.views[i].H_x() * error.e_x - H_m * error.e_m[i]);
  }
}

ErrorCovariance with_lamps() {
  ErrorCovariance errors(kThreeLamps, kThreeLamps, kSigmaScales);
  const Steps none([](const Steps&) {});
  for (std::size_t i = 0; i < kThreeLamps; ++i)
    errors.add(static_cast<std::int64_t>(i), Symmetric3{0.04, 0.01, 0.0, 0.05, 0.01, 0.03});
  return errors;
}

void go(ErrorCovariance& errors, const Steps& steps) {
  errors.predict(steps.moved);
  errors.begin_image(kThreeLamps);
  for (std::size_t i = 0; i < kThreeLamps; ++i)
    errors.sight(i, static_cast<std::int64_t>(i), steps.views[i], steps.Sigma[i], kNoiseOfSighting);
  errors.draw(steps.proposal);
  for (std::size_t i = 0; i < kThreeLamps; ++i)
    errors.learn(i, static_cast<std::int64_t>(i), steps.views[i], steps.Sigma[i], kNoiseOfSighting);
  errors.keep_pose(steps.step);
}

/// Compares each entry relative to the standard deviations that belong to it.
void expect_near(const Eigen::Matrix3d& sampled, const Eigen::Matrix3d& computed) {
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      EXPECT_NEAR(sampled(i, j), computed(i, j), 0.03 * std::sqrt(computed(i, i) * computed(j, j))) << i << ", " << j;
}

TEST(ErrorCovariance, IsThatOfErrorsDrawn) {
  constexpr int kDraws = 20000;
  ErrorCovariance errors = with_lamps();
  const Steps computed([&](const Steps& steps) { go(errors, steps); });

  RandomDraws draws(5);
  std::vector<Drawn> all(kDraws);
  for (Drawn& one : all) {
    one.e_scales = Eigen::Vector2d(draws.normal(kSigmaScales.x()), draws.normal(kSigmaScales.y()));
    for (Eigen::Vector3d& e_m : one.e_m) e_m = drawn(Symmetric3{0.04, 0.01, 0.0, 0.05, 0.01, 0.03}.matrix(), draws);
  }
  const Steps sampled([&](const Steps& steps) {
    for (Drawn& one : all) go(one, steps, draws);
  });
  Eigen::Matrix3d of_pose = Eigen::Matrix3d::Zero(), of_lamp = of_pose;
  ByScales with_scales = ByScales::Zero();
  for (const Drawn& one : all) {
    of_pose += one.e_x * one.e_x.transpose() / kDraws;
    of_lamp += one.e_m[1] * one.e_m[1].transpose() / kDraws;
    with_scales += one.e_x * one.e_scales.transpose() / kDraws;
  }
  const ByScales by_scales = errors.by_scales();
  const Eigen::Matrix3d of_scales = by_scales * errors.scale_variances().asDiagonal() * by_scales.transpose();
  expect_near(of_pose, errors.pose() + of_scales);
  expect_near(of_lamp, errors.landmark(1));
  const ByScales computed_with = by_scales * errors.scale_variances().asDiagonal();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 2; ++j)
      EXPECT_NEAR(with_scales(i, j), computed_with(i, j), 0.03 * std::sqrt(errors.pose()(i, i)) * kSigmaScales(j));
}

TEST(ErrorCovariance, SaysMoreThanTheParticlesOwnCovariances) {
  ErrorCovariance errors = with_lamps();
  const Steps steps([&](const Steps& now) { go(errors, now); });
  EXPECT_GT(errors.pose().trace(), 2.0 * steps.proposal.trace());
  for (std::size_t i = 0; i < kThreeLamps; ++i)
    EXPECT_GT(errors.landmark(static_cast<std::int64_t>(i)).trace(), steps.Sigma[i].trace());
}

TEST(ErrorCovariance, OfANewLandmarkIsThatOfThePoseByItsLeverArm) {
  ErrorCovariance errors(2, 1, Eigen::Vector2d::Zero());
  MovedPose moved;
  moved.G.setIdentity();
  moved.noise = Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal();
  moved.by_scales.setZero();
  errors.predict(moved);
  errors.add(7, Pose2{1.0, 2.0, 0.3}, {3.0, 7.0, 5.0}, {0.001, 0.0, 0.0, 0.002, 0.0, 0.003});
  const Eigen::Matrix3d of_landmark = errors.landmark(7);
  EXPECT_NEAR(of_landmark(0, 0), 0.01 + 25.0 * 0.09 + 0.001, 1e-12);
  EXPECT_NEAR(of_landmark(1, 1), 0.04 + 4.0 * 0.09 + 0.002, 1e-12);
  EXPECT_NEAR(of_landmark(0, 1), -10.0 * 0.09, 1e-12);
  EXPECT_NEAR(of_landmark(2, 2), 0.003, 1e-12);
}

TEST(ErrorCovariance, ForgetsLandmarksAndKeepsTheOthers) {
  ErrorCovariance errors = with_lamps();
  const Steps steps([&](const Steps& now) { go(errors, now); });
  const Eigen::Matrix3d of_last = errors.landmark(2);
  errors.keep_if([](std::int64_t id) { return id == 2; });
  EXPECT_FALSE(errors.has(0));
  EXPECT_FALSE(errors.has(1));
  ASSERT_TRUE(errors.has(2));
  EXPECT_EQ(errors.landmark(2), of_last);
}

/// A landmark mapped from two kept poses has the weighted errors of both poses.
TEST(ErrorCovariance, OfALandmarkMappedFromPosesKept) {
  ErrorCovariance errors(1, 1, Eigen::Vector2d::Zero());
  MovedPose moved;
  moved.G.setIdentity();
  moved.noise = Eigen::Vector3d(0.01, 0.0, 0.0).asDiagonal();
  moved.by_scales.setZero();
  for (std::int64_t step = 0; step < 3; ++step) {
    errors.predict(moved);
    errors.keep_pose(step);
  }
  EXPECT_FALSE(errors.keeps_pose(3));
  ASSERT_TRUE(errors.keeps_pose(0) && errors.keeps_pose(2));
  errors.mapped_from(0, 0.5 * Eigen::Matrix3d::Identity());
  errors.mapped_from(2, 0.5 * Eigen::Matrix3d::Identity());
  errors.add(1, Symmetric3{});
  // The variances are 0.01 and 0.03, with 0.01 in common.
  EXPECT_NEAR(errors.landmark(1)(0, 0), 0.25 * (0.01 + 0.03 + 2.0 * 0.01), 1e-15);
}

TEST(ErrorCovariance, ForgetsPosesOfLongAgoAndKeepsTheLandmarks) {
  constexpr std::int64_t kSteps = 200;
  ErrorCovariance errors = with_lamps();
  MovedPose moved;
  moved.G.setIdentity();
  moved.noise = Eigen::Vector3d(0.01, 0.0, 0.0).asDiagonal();
  moved.by_scales.setZero();
  for (std::int64_t step = 0; step < kSteps; step += 2) {  // every other step adds no new landmark
    errors.predict(moved);
    errors.keep_pose(step);
  }
  EXPECT_TRUE(errors.keeps_pose(kSteps - 2) && errors.keeps_pose(kSteps - 48));
  EXPECT_FALSE(errors.keeps_pose(kSteps - 50) || errors.keeps_pose(kSteps - 3) || errors.keeps_pose(0));
  EXPECT_NEAR(errors.landmark(0)(0, 0), 0.04, 1e-15);
  errors.place_pose(Eigen::Matrix3d::Identity());
  EXPECT_FALSE(errors.keeps_pose(kSteps - 2));
  EXPECT_NEAR(errors.landmark(2)(1, 1), 0.05, 1e-15);
}

/// The error of a point fitted to rays, when the poses of the rays have errors that accumulate step by step.
TEST(ErrorOfFit, IsThatOfPointsFittedFromPathsDrawn) {
  constexpr int kDraws = 4000;
  constexpr std::size_t kRays = 8;
  const Eigen::Vector3d lamp(1.0, 3.0, 6.5);
  const Symmetric3 of_step{1e-5, 0.0, 0.0, 1e-5, 0.0, 2e-5};
  std::vector<Symmetric3> gathered(kRays);
  for (std::size_t i = kRays - 1; i-- > 0;) gathered[i] = gathered[i + 1] + of_step;
  RandomDraws draws(11);
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  LampFitError computed;
  for (int n = 0; n < kDraws; ++n) {
    std::vector<LampSighting> seen;
    std::vector<Pose2> believed(kRays);
    // Each step has twice the variance: once from the means of the proposals, once from the draws. The last pose is
    // exact.
    Pose2 T_wrong_true;
    for (std::size_t i = kRays; i-- > 0;) {
      const Pose2 truth{0.3 * static_cast<double>(i), 0.0, 0.0};
      if (i + 1 < kRays) {
        const Eigen::Vector3d off = drawn((of_step + of_step).matrix(), draws);
        const Pose2 next{0.3 * static_cast<double>(i + 1), 0.0, 0.0};
        T_wrong_true = T_wrong_true * next * Pose2{off.x(), off.y(), off.z()} * inverse(next);
      }
      believed[i] = T_wrong_true * truth;
    }
    for (std::size_t i = 0; i < kRays; ++i) {
      const Viewpoint from(Pose2{0.3 * static_cast<double>(i), 0.0, 0.0}, kEyeHeight_m);
      const Eigen::Vector2d z = direction_of(view(from, lamp), 0.0) + drawn(kNoiseOfSighting, draws);
      seen.push_back(make_sighting(z.x(), z.y(), kNoiseOfSighting));
    }
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < kRays; ++i) rays.push_back({Viewpoint(believed[i], kEyeHeight_m), &seen[i]});
    const std::optional<LampFit> fit = fit_point(rays, gathered, lamp);
    ASSERT_TRUE(fit);
    sampled += (fit->p_map - lamp) * (fit->p_map - lamp).transpose() / kDraws;
    if (n == 0) {
      std::vector<Ray> exact;
      for (std::size_t i = 0; i < kRays; ++i)
        exact.push_back({Viewpoint(Pose2{0.3 * static_cast<double>(i), 0.0, 0.0}, kEyeHeight_m), &seen[i]});
      computed = error_of_fit(exact, gathered, lamp, kRays - 1);
    }
  }
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_NEAR(std::sqrt(sampled(i, i) / computed.own.matrix()(i, i)), 1.0, 0.1) << i;
}

}  // namespace
}  // namespace azimuth
