// The iterated update compared with the maximum a posteriori estimate of a dense Gauss-Newton solver.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <iostream>
#include <numeric>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/ekf/invariant_motion.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using Retraction = JointState::Retraction;

constexpr double kSigmaAzimuth_rad = 0.01;
constexpr double kAlwaysIterate_rad = 10.0;

BearingEkfSettings settings_for(Retraction retraction, int iterations, double min_distance_m = 0.05) {
  BearingEkfSettings settings;
  settings.retraction = retraction;
  settings.max_iterations = iterations;
  settings.iterate_below_heading_rad = kAlwaysIterate_rad;
  settings.min_distance_m = min_distance_m;
  return settings;
}

/// A filter that knows five landmarks well and has then driven without bearings: the heading of its prior is very
/// uncertain.
struct LostRobot {
  BearingEkf ekf;
  std::vector<Index> landmarks;

  LostRobot(const BearingEkfSettings& settings, const Eigen::Vector3d& sigma_pose) : ekf(settings) {
    const Pose2 second{3.0, 1.0, 0.5};
    const Index clone = ekf.clone_robot();
    ekf.predict({second, Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal(), 3.0, 0.5});
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(5.0, 1.0), {1.0, 5.0}, {-3.0, 3.0}, {-2.0, -4.0}, {4.0, -3.0}}) {
      const Sighting i = ekf.sighting_from(clone, predict_bearing(Pose2{}, p, 0.0)->azimuth_rad);
      const Sighting j = ekf.sighting_from(JointState::kPose, predict_bearing(second, p, 0.0)->azimuth_rad);
      landmarks.push_back(ekf.add_point(*intersect(i, j), clone, JointState::kPose, kSigmaAzimuth_rad));
    }
    ekf.remove(clone, BlockKind::pose);
    const Eigen::Matrix3d blind = sigma_pose.array().square().matrix().asDiagonal();
    ekf.predict({{-2.5, -1.0, 0.3}, blind, 3.0, 0.3});
  }

  std::vector<MappedSighting> seen_from(const Pose2& true_pose, RandomDraws* noise = nullptr) const {
    std::vector<MappedSighting> sightings;
    for (const Index block : landmarks) {
      const auto predicted = predict_bearing(true_pose, ekf.state().position(block), 0.0);
      const double error_rad = noise != nullptr ? noise->normal(kSigmaAzimuth_rad) : 0.0;
      sightings.push_back({JointState::kPose, block, BlockKind::point, predicted->azimuth_rad + error_rad,
                           kSigmaAzimuth_rad * kSigmaAzimuth_rad});
    }
    return sightings;
  }

  std::vector<Index> entries() const {
    std::vector<Index> entries{0, 1, 2};
    for (const Index block : landmarks) entries.insert(entries.end(), {block, block + 1});
    return entries;
  }
  Eigen::VectorXd mean() const {
    const auto all = entries();
    return Eigen::VectorXd::NullaryExpr(static_cast<Index>(all.size()),
                                        [&](Index i) { return ekf.state().mean(all[static_cast<std::size_t>(i)]); });
  }
  Eigen::MatrixXd covariance() const {
    const auto all = entries();
    Eigen::MatrixXd P(static_cast<Index>(all.size()), static_cast<Index>(all.size()));
    ekf.state().covariance(all, all, P);
    return P;
  }
};

/// The posterior of robot and landmarks in dense form. Landmark i has the entries 3 + 2 i and 4 + 2 i.
class DensePosterior {
 public:
  DensePosterior(const LostRobot& prior, const std::vector<MappedSighting>& sightings, Retraction retraction)
      : prior_(prior.mean()), P_(prior.covariance()), sightings_(sightings), retraction_(retraction) {}

  Eigen::VectorXd retract(const Eigen::VectorXd& delta) const {
    Eigen::VectorXd x = prior_ + delta;
    if (retraction_ == Retraction::additive) return x;
    const InvariantMotion turn(delta(2));
    x.head<2>() = turn.apply(prior_.head<2>(), delta.head<2>());
    for (Index i = 3; i < x.size(); i += 2) x.segment<2>(i) = turn.apply(prior_.segment<2>(i), delta.segment<2>(i));
    return x;
  }

  /// The negative log posterior as a function of the correction of the prior.
  double cost(const Eigen::VectorXd& delta) const {
    return 0.5 * delta.dot(P_.llt().solve(delta)) +
           0.5 * innovations(delta).squaredNorm() / (kSigmaAzimuth_rad * kSigmaAzimuth_rad);
  }

  Eigen::VectorXd maximum() const {
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(prior_.size());
    for (int iteration = 0; iteration < 200; ++iteration) {
      const Eigen::MatrixXd H = jacobian(delta), weighted = H.transpose() / (kSigmaAzimuth_rad * kSigmaAzimuth_rad);
      const Eigen::VectorXd gradient = P_.llt().solve(delta) - weighted * innovations(delta);
      Eigen::VectorXd step = -(P_.inverse() + weighted * H).ldlt().solve(gradient);
      while (cost(delta + step) > cost(delta) && step.norm() > 1e-14) step *= 0.5;
      delta += step;
      if (step.norm() < 1e-13) break;
    }
    return delta;
  }

  /// The derivative of the predicted azimuths with respect to the correction.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& delta) const {
    // The innovations of these tests stay away from the wrap at pi.
    return -numeric_jacobian([&](const Eigen::VectorXd& at) { return innovations(at); }, delta, {}, 1e-4);
  }
  const Eigen::MatrixXd& prior_covariance() const { return P_; }

 private:
  Eigen::VectorXd innovations(const Eigen::VectorXd& delta) const {
    const Eigen::VectorXd x = retract(delta);
    Eigen::VectorXd innovations(static_cast<Index>(sightings_.size()));
    for (Index i = 0; i < innovations.size(); ++i) {
      const auto predicted = predict_bearing(Pose2{x(0), x(1), x(2)}, Eigen::Vector2d(x.segment<2>(3 + 2 * i)), 0.0);
      innovations(i) = wrap(sightings_[static_cast<std::size_t>(i)].azimuth_rad - predicted->azimuth_rad);
    }
    return innovations;
  }

  Eigen::VectorXd prior_;
  Eigen::MatrixXd P_;
  std::vector<MappedSighting> sightings_;
  Retraction retraction_;
};

/// The largest difference in standard deviations of `covariance`.
double in_sigmas(Eigen::VectorXd difference, const Eigen::MatrixXd& covariance) {
  difference(2) = wrap(difference(2));
  return (difference.array().abs() / covariance.diagonal().array().sqrt()).maxCoeff();
}

const Eigen::Vector3d kHardSigma(0.5, 0.5, 0.5);
const Eigen::Vector3d kIteratedSigma(0.2, 0.2, 0.05);  // the heading is at the limit of iteration

class Iterated : public testing::TestWithParam<Retraction> {};

TEST_P(Iterated, ReachesTheMaximumAPosteriori) {
  RandomDraws draws(91);
  // The filter transports the invariant error unchanged, so its maximum is exact only for small turns. The invariant
  // update is therefore tested within the heading limit at which the filter iterates.
  const bool additive = GetParam() == Retraction::additive;
  const Eigen::Vector3d sigma = additive ? kHardSigma : kIteratedSigma;
  double plain_worst = 0.0, iterated_worst = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    LostRobot iterated(settings_for(GetParam(), 20), sigma), plain(settings_for(GetParam(), 1), sigma);
    const double heading_error_rad = (trial % 2 == 0 ? 1.0 : -1.0) * sigma(2) * draws.uniform(1.0, 2.0);
    const Pose2 true_pose =
        iterated.ekf.state().pose() * Pose2{draws.normal(sigma(0)), draws.normal(sigma(1)), heading_error_rad};
    auto sightings = iterated.seen_from(true_pose, &draws);
    if (trial % 4 < 2) sightings.resize(2);  // too few bearings to determine a pose; the prior supplies the rest
    const DensePosterior posterior(iterated, sightings, GetParam());
    const Eigen::VectorXd delta = posterior.maximum();

    ASSERT_TRUE(iterated.ekf.update(sightings));
    ASSERT_TRUE(plain.ekf.update(sightings));
    const Eigen::VectorXd best = posterior.retract(delta);
    iterated_worst = std::max(iterated_worst, in_sigmas(iterated.mean() - best, iterated.covariance()));
    plain_worst = std::max(plain_worst, in_sigmas(plain.mean() - best, iterated.covariance()));
  }
  std::cout << "worst distance from the maximum in posterior standard deviations: iterated " << iterated_worst
            << ", plain " << plain_worst << "\n";
  EXPECT_LT(iterated_worst, additive ? 1e-3 : 0.2);
  EXPECT_GT(plain_worst, 3.0 * iterated_worst) << "a prior this hard is what the iteration is for";
}

TEST_P(Iterated, CovarianceIsThatAtTheMaximum) {
  const bool additive = GetParam() == Retraction::additive;
  const Eigen::Vector3d sigma = additive ? kHardSigma : kIteratedSigma;
  // The derivative of the exponential would turn the prior by half the correction. The invariant filter leaves the
  // prior unchanged, so that an unobservable turn remains unobservable. Thin ellipses show the difference.
  const double tolerance = additive ? 0.01 : 0.25;

  LostRobot robot(settings_for(GetParam(), 20), sigma);
  const Pose2 true_pose = robot.ekf.state().pose() * Pose2{sigma(0), -sigma(1), 1.5 * sigma(2)};
  const auto sightings = robot.seen_from(true_pose);
  const DensePosterior posterior(robot, sightings, GetParam());
  const Eigen::VectorXd delta = posterior.maximum();
  const Eigen::MatrixXd H = posterior.jacobian(delta);
  const Eigen::MatrixXd information = H.transpose() * H / (kSigmaAzimuth_rad * kSigmaAzimuth_rad);
  // Maps corrections of the prior to the coordinates of the new mean.
  const Eigen::MatrixXd by_delta =
      numeric_jacobian([&](const Eigen::VectorXd& at) { return posterior.retract(at); }, delta);
  const Eigen::MatrixXd expected =
      by_delta * (posterior.prior_covariance().inverse() + information).inverse() * by_delta.transpose();

  ASSERT_TRUE(robot.ekf.update(sightings));
  const Eigen::ArrayXd ratio = robot.covariance().diagonal().array() / expected.diagonal().array();
  std::cout << "variances over those of the posterior: " << ratio.minCoeff() << " to " << ratio.maxCoeff() << "\n";
  EXPECT_NEAR(ratio.minCoeff(), 1.0, tolerance);
  EXPECT_NEAR(ratio.maxCoeff(), 1.0, tolerance);
}

TEST_P(Iterated, NotWithAHeadingLessCertainThanTheLimit) {
  BearingEkfSettings limited = settings_for(GetParam(), 20);
  limited.iterate_below_heading_rad = 0.4;
  LostRobot iterated(limited, kHardSigma), plain(settings_for(GetParam(), 1), kHardSigma);
  const auto sightings = iterated.seen_from(iterated.ekf.state().pose() * Pose2{0.3, -0.2, 0.5});
  ASSERT_TRUE(iterated.ekf.update(sightings));
  ASSERT_TRUE(plain.ekf.update(sightings));
  EXPECT_EQ(iterated.mean(), plain.mean());
  EXPECT_EQ(iterated.covariance(), plain.covariance());
}

TEST_P(Iterated, SmallCorrectionsAreThoseOfThePlainUpdate) {
  const Eigen::Vector3d easy(1e-3, 1e-3, 1e-3);
  LostRobot iterated(settings_for(GetParam(), 20), easy), plain(settings_for(GetParam(), 1), easy);
  const auto sightings = iterated.seen_from(iterated.ekf.state().pose() * Pose2{1e-3, -5e-4, 1e-3});
  ASSERT_TRUE(iterated.ekf.update(sightings));
  ASSERT_TRUE(plain.ekf.update(sightings));
  EXPECT_LT(in_sigmas(iterated.mean() - plain.mean(), plain.covariance()), 1e-2);
}

/// Expects both filters to be equal to the last bit.
void expect_same(const LostRobot& a, const LostRobot& b) {
  EXPECT_EQ(a.mean(), b.mean());
  EXPECT_EQ(a.covariance(), b.covariance());
}

TEST_P(Iterated, FallsBackToThePlainUpdateWhenTheBearingsCannotBe) {
  // The bearings require a correction of many standard deviations, so there is no linearisation point near the prior.
  const Eigen::Vector3d confident(0.02, 0.02, 0.02);
  LostRobot iterated(settings_for(GetParam(), 20), confident), plain(settings_for(GetParam(), 1), confident);
  const auto sightings = iterated.seen_from(iterated.ekf.state().pose() * Pose2{1.5, 1.0, 1.0});
  EXPECT_TRUE(iterated.ekf.update(sightings));
  EXPECT_TRUE(plain.ekf.update(sightings));
  expect_same(iterated, plain);
}

TEST_P(Iterated, FallsBackWhenALandmarkComesTooNearOnTheWay) {
  const Eigen::Vector3d position_unknown(0.7, 0.7, 0.05);
  const LostRobot probe(settings_for(GetParam(), 1), position_unknown);
  const Pose2 prior = probe.ekf.state().pose();
  const Eigen::Vector2d nearest = probe.ekf.state().position(probe.landmarks.back());
  const double distance_m = (nearest - prior.position()).norm();
  const Eigen::Vector2d towards = 0.5 * (nearest - prior.position()) / distance_m;
  const Pose2 true_pose{prior.x_m + towards.x(), prior.y_m + towards.y(), prior.heading_rad};
  const double limit_m = distance_m - 0.1;  // the landmark is usable from the prior pose, but not from the true pose

  LostRobot iterated(settings_for(GetParam(), 20, limit_m), position_unknown);
  LostRobot plain(settings_for(GetParam(), 1, limit_m), position_unknown);
  std::vector<MappedSighting> usable;
  for (const MappedSighting& sighting : iterated.seen_from(true_pose))
    if (iterated.ekf.linearise(sighting)) usable.push_back(sighting);
  ASSERT_GE(usable.size(), 3u);
  EXPECT_TRUE(iterated.ekf.update(usable));
  EXPECT_TRUE(plain.ekf.update(usable));
  expect_same(iterated, plain);
}

INSTANTIATE_TEST_SUITE_P(Both, Iterated, testing::Values(Retraction::additive, Retraction::invariant),
                         test::PrintedName());

}  // namespace
}  // namespace azimuth
