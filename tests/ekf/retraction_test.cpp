// Properties of the invariant retraction: it equals the additive correction to first order, does not depend on the
// frame of the map, and gains no information on the direction of the whole map.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>

#include "slam/ekf/invariant_motion.hpp"
#include "slam/ekf/relinearisation.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using Retraction = JointState::Retraction;

constexpr int kLandmarks = 8;
constexpr Index kSize = 3 + 2 * kLandmarks;
constexpr Index kHeading = JointState::kPose + 2;

Index landmark_block(int landmark) { return 3 + 2 * landmark; }

/// A robot among landmarks, all uncertain and correlated. The blocks follow each other without gaps.
struct LinearProblem {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

LinearProblem random_problem(RandomDraws& draws) {
  LinearProblem problem{Eigen::VectorXd(kSize), draws.covariance(kSize, 0.1)};
  problem.mean.head<3>() = draws.pose(1.0).vector();
  for (int i = 0; i < kLandmarks; ++i)
    problem.mean.segment<2>(landmark_block(i)) =
        problem.mean.head<2>() +
        draws.uniform(2.0, 8.0) * Eigen::Rotation2Dd(draws.uniform(-kPi, kPi)).toRotationMatrix().col(0);
  return problem;
}

JointState state_of(const LinearProblem& problem) {
  JointState state({problem.mean(0), problem.mean(1), problem.mean(2)}, problem.covariance.topLeftCorner<3, 3>());
  std::vector<Index> sources{0, 1, 2};
  for (int i = 0; i < kLandmarks; ++i) {
    const Index block = landmark_block(i);
    const Eigen::MatrixXd before = problem.covariance.topLeftCorner(block, block);
    const Eigen::MatrixXd cross = problem.covariance.block(0, block, block, 2);
    const Eigen::MatrixXd J = before.llt().solve(cross).transpose();
    state.add(BlockKind::point, problem.mean.segment<2>(block), sources, J,
              problem.covariance.block<2, 2>(block, block) - J * cross);
    sources.insert(sources.end(), {block, block + 1});
  }
  return state;
}

LinearProblem problem_of(const JointState& state) {
  LinearProblem problem{Eigen::VectorXd(kSize), Eigen::MatrixXd(kSize, kSize)};
  for (Index r = 0; r < kSize; ++r) {
    problem.mean(r) = state.mean(r);
    for (Index c = 0; c < kSize; ++c) problem.covariance(r, c) = state.covariance(r, c);
  }
  return problem;
}

std::vector<ObservationRow> rows_at(const JointState& state, const Eigen::VectorXd& azimuths_rad, double sigma_rad) {
  std::vector<ObservationRow> rows;
  for (int i = 0; i < kLandmarks; ++i) {
    const MappedSighting sighting{JointState::kPose, landmark_block(i), BlockKind::point, azimuths_rad(i),
                                  sigma_rad * sigma_rad};
    rows.push_back(*linearise(sighting, CameraOffsets{}, 0.0, [&](Index entry) { return state.mean(entry); }));
  }
  return rows;
}

Eigen::VectorXd azimuths_seen(const Pose2& pose, const Eigen::VectorXd& state) {
  Eigen::VectorXd azimuths(kLandmarks);
  for (int i = 0; i < kLandmarks; ++i)
    azimuths(i) = predict_bearing(pose, Eigen::Vector2d(state.segment<2>(landmark_block(i))), 0.0)->azimuth_rad;
  return azimuths;
}
Eigen::VectorXd azimuths_seen(const Eigen::VectorXd& state) {
  return azimuths_seen({state(0), state(1), state(2)}, state);
}

// ---- The motion of one position ----

TEST(InvariantMotion, IsTheExponentialOfTurnAndTranslation) {
  // The exponential, summed as a power series of the 3 x 3 generator.
  RandomDraws draws(61);
  for (int i = 0; i < 300; ++i) {
    const double scale = i % 3 == 0 ? 1e-5 : 1.0, turn_rad = draws.uniform(-2.0, 2.0) * scale;
    const Eigen::Vector2d q = draws.point(20.0), dq = draws.point(scale);
    const Eigen::Vector2d xi = dq - turn_rad * perpendicular(q);
    Eigen::Matrix3d generator = Eigen::Matrix3d::Zero(), sum = Eigen::Matrix3d::Identity(), term = sum;
    generator << 0.0, -turn_rad, xi.x(), turn_rad, 0.0, xi.y(), 0.0, 0.0, 0.0;
    for (int n = 1; n < 40; ++n) {
      term = term * generator / n;
      sum += term;
    }
    const Eigen::Vector2d expected = (sum * q.homogeneous()).head<2>();
    EXPECT_LT((InvariantMotion(turn_rad).apply(q, dq) - expected).norm(), 1e-11);
  }
}

TEST(InvariantMotion, IsTheAdditiveOneWithoutATurn) {
  const Eigen::Vector2d q(3.0, -4.0), dq(0.1, 0.2);
  EXPECT_EQ(InvariantMotion(0.0).apply(q, dq), q + dq);
}

TEST(InvariantMotion, APureTurnAboutAnyPointIsExact) {
  RandomDraws draws(62);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d centre = draws.point(10.0), q = draws.point(10.0);
    const double turn_rad = draws.uniform(-1.0, 1.0);
    const Eigen::Vector2d dq = turn_rad * perpendicular(q - centre);
    const Eigen::Vector2d turned = centre + Eigen::Rotation2Dd(turn_rad) * (q - centre);
    EXPECT_LT((InvariantMotion(turn_rad).apply(q, dq) - turned).norm(), 1e-11);
  }
}

// ---- (a) The additive correction to first order ----

LinearProblem updated(const LinearProblem& problem, const Eigen::VectorXd& innovations, Retraction retraction) {
  JointState state = state_of(problem);
  const auto rows = rows_at(state, azimuths_seen(problem.mean) + innovations, 0.02);
  EXPECT_TRUE(state.update(rows, retraction));
  return problem_of(state);
}

TEST(InvariantRetraction, IsTheAdditiveOneToFirstOrder) {
  RandomDraws draws(63);
  for (int trial = 0; trial < 20; ++trial) {
    const LinearProblem problem = random_problem(draws);
    const Eigen::VectorXd direction = draws.normals(kLandmarks);
    const auto difference = [&](double scale) {
      const LinearProblem additive = updated(problem, scale * direction, Retraction::additive);
      const LinearProblem invariant = updated(problem, scale * direction, Retraction::invariant);
      return std::pair((additive.mean - invariant.mean).norm(), (additive.covariance - invariant.covariance).norm());
    };
    const auto [mean_coarse, covariance_coarse] = difference(1e-3);
    const auto [mean_fine, covariance_fine] = difference(1e-4);
    EXPECT_NEAR(mean_coarse / mean_fine, 100.0, 5.0) << "means differ by the square of the correction";
    EXPECT_NEAR(covariance_coarse / covariance_fine, 10.0, 0.5) << "covariances by the correction";
    EXPECT_LT(difference(0.0).second, 1e-15);
  }
}

// ---- (b) The frame of the map does not matter ----

LinearProblem transformed(const LinearProblem& problem, const Pose2& T) {
  LinearProblem result = problem;
  Eigen::MatrixXd rotation = Eigen::MatrixXd::Identity(kSize, kSize);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T.heading_rad).toRotationMatrix();
  rotation.topLeftCorner<2, 2>() = R;
  result.mean.head<3>() = (T * Pose2{problem.mean(0), problem.mean(1), problem.mean(2)}).vector();
  for (int i = 0; i < kLandmarks; ++i) {
    const Index block = landmark_block(i);
    rotation.block<2, 2>(block, block) = R;
    result.mean.segment<2>(block) = T * Eigen::Vector2d(problem.mean.segment<2>(block));
  }
  result.covariance = rotation * problem.covariance * rotation.transpose();
  return result;
}

class Gauge : public testing::TestWithParam<Retraction> {};

TEST_P(Gauge, MovingTheWholeProblemCommutesWithTheUpdate) {
  RandomDraws draws(64);
  for (int trial = 0; trial < 50; ++trial) {
    const LinearProblem problem = random_problem(draws);
    const Pose2 T_new_old = draws.pose(100.0);
    const Eigen::VectorXd innovations = 0.2 * draws.normals(kLandmarks);  // large, so that second-order terms matter
    const LinearProblem here = transformed(updated(problem, innovations, GetParam()), T_new_old);
    const LinearProblem there = updated(transformed(problem, T_new_old), innovations, GetParam());
    Eigen::VectorXd difference = here.mean - there.mean;
    difference(kHeading) = wrap(difference(kHeading));
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((here.covariance - there.covariance).cwiseAbs().maxCoeff(), 1e-9);
  }
}
INSTANTIATE_TEST_SUITE_P(Both, Gauge, testing::Values(Retraction::additive, Retraction::invariant),
                         test::PrintedName());

// ---- (c) Bearings say nothing about the direction of the whole map ----

/// N^T P^-1 N: the information on a turn of the robot and the map together about the origin.
double information_on_the_turn(const JointState& state) {
  const LinearProblem problem = problem_of(state);
  Eigen::VectorXd N = Eigen::VectorXd::Zero(kSize);
  N.head<2>() = perpendicular(problem.mean.head<2>());
  N(kHeading) = 1.0;
  for (int i = 0; i < kLandmarks; ++i)
    N.segment<2>(landmark_block(i)) = perpendicular(problem.mean.segment<2>(landmark_block(i)));
  return N.dot(problem.covariance.llt().solve(N));
}

/// The covariance of landmarks that are roughly placed relative to a robot of uncertain heading. The direction of the
/// whole map is as well known as the robot's heading, and must stay so.
Eigen::MatrixXd seen_from_the_robot(const Eigen::VectorXd& mean) {
  constexpr double kSigmaPlace_m = 0.7, kSigmaRobot_m = 0.1, kSigmaHeading_rad = 0.3;
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(kSize, 3);
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(kSize, kSigmaPlace_m * kSigmaPlace_m);
  B.topRows<3>().setIdentity();
  variances.head<3>().setZero();
  for (int i = 0; i < kLandmarks; ++i) {
    const Index block = landmark_block(i);
    B.block<2, 2>(block, 0).setIdentity();
    B.block<2, 1>(block, 2) = perpendicular(mean.segment<2>(block) - mean.head<2>());
  }
  const Eigen::Vector3d sigma(kSigmaRobot_m, kSigmaRobot_m, kSigmaHeading_rad);
  Eigen::MatrixXd P = B * sigma.array().square().matrix().asDiagonal() * B.transpose();
  P.diagonal() += variances;
  return P;
}

/// Drives 20 steps past the landmarks, from an initial error drawn from the covariance. Returns the information on the
/// turn before the first step and after each step.
std::vector<double> drive(unsigned seed, Retraction retraction, double motion_noise_sigma) {
  constexpr double kSigmaBearing_rad = 0.02;
  RandomDraws draws(seed);
  LinearProblem problem = random_problem(draws);
  problem.covariance = seen_from_the_robot(problem.mean);
  const Eigen::MatrixXd L = problem.covariance.llt().matrixL();
  const Eigen::VectorXd truth = problem.mean + L * draws.normals(kSize);
  Pose2 true_pose{truth(0), truth(1), truth(2)};

  JointState state = state_of(problem);
  std::vector<double> information{information_on_the_turn(state)};
  for (int step = 0; step < 20; ++step) {
    const Control control{0.15, 0.1, 0.1};
    true_pose = move(true_pose, control);
    const Pose2 predicted = move(state.pose(), control);
    const Eigen::Vector3d variances = Eigen::Vector3d::Constant(motion_noise_sigma * motion_noise_sigma);
    state.move_robot(predicted, motion_jacobians(state.pose().heading_rad, control).G, variances.asDiagonal());
    const Eigen::VectorXd azimuths = azimuths_seen(true_pose, truth) + kSigmaBearing_rad * draws.normals(kLandmarks);
    EXPECT_TRUE(state.update(rows_at(state, azimuths, kSigmaBearing_rad), retraction));
    information.push_back(information_on_the_turn(state));
  }
  return information;
}

TEST(InvariantRetraction, GainsNoInformationOnTheDirectionOfTheMap) {
  std::vector<double> additive_gains;
  for (unsigned seed = 70; seed < 101; ++seed) {
    const std::vector<double> invariant = drive(seed, Retraction::invariant, 0.0);
    for (const double information : invariant) EXPECT_NEAR(information / invariant.front(), 1.0, 1e-6);
    const std::vector<double> additive = drive(seed, Retraction::additive, 0.0);
    additive_gains.push_back(additive.back() / additive.front());
  }
  std::ranges::sort(additive_gains);
  const double median = additive_gains[additive_gains.size() / 2];
  std::cout << "information on the turn of the map, after 20 updates over before: invariant 1; additive "
            << additive_gains.front() << " to " << additive_gains.back() << ", median " << median << "\n";
  EXPECT_GT(median, 2.0) << "the textbook filter's spurious gain, which the invariant one is there to avoid";
}

TEST(InvariantRetraction, OdometryNoiseCanOnlyLoseInformation) {
  for (unsigned seed = 100; seed < 110; ++seed) {
    const std::vector<double> information = drive(seed, Retraction::invariant, 0.02);
    for (std::size_t i = 1; i < information.size(); ++i) EXPECT_LE(information[i], information[i - 1] * (1.0 + 1e-6));
  }
}

}  // namespace
}  // namespace azimuth
