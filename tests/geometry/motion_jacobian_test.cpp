#include <gtest/gtest.h>

#include "slam/geometry/motion.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr int kDraws = 250;

/// The motion model with every input of eq 28 free: (x, y, heading, distance, first turn, second turn, drift).
Eigen::Vector3d moved(const Eigen::VectorXd& in) {
  const Control control{in(3), in(4), in(5) + in(6)};  // drift adds to the last turn (mathematics I.3)
  return move({in(0), in(1), in(2)}, control).vector();
}

void expect_motion_jacobians_match(const Pose2& pose, const Control& control) {
  Eigen::VectorXd in(7);
  in << pose.vector(), control.distance_m, control.first_turn_rad, control.second_turn_rad, 0.0;
  const Eigen::MatrixXd numeric = numeric_jacobian(moved, in, {2});
  const MotionJacobians jacobians = motion_jacobians(pose.heading_rad, control);
  EXPECT_LT(largest_difference(jacobians.G, numeric.leftCols<3>()), kJacobianTolerance);
  EXPECT_LT(largest_difference(jacobians.V, numeric.rightCols<4>()), kJacobianTolerance);
}

TEST(MotionJacobians, AtIdentity) { expect_motion_jacobians_match({}, {}); }

TEST(MotionJacobians, AtTinyMotions) {
  RandomDraws draws(1);
  for (int i = 0; i < kDraws; ++i) expect_motion_jacobians_match(draws.pose(1e-6), draws.control(1e-6, 1e-6));
}

TEST(MotionJacobians, AtRandomMotions) {
  RandomDraws draws(2);
  for (int i = 0; i < kDraws; ++i) expect_motion_jacobians_match(draws.pose(20.0), draws.control(3.0, kPi));
}

TEST(MotionJacobians, AcrossTheWrapOfTheHeading) {
  for (const double heading_rad : {-kPi, kPi - 1e-9, kPi - 1e-4, -kPi + 1e-4})
    expect_motion_jacobians_match({1.0, -2.0, heading_rad}, {0.7, 1e-5, -1e-5});
}

/// Tests apply(): G is the derivative by the pose, and the noise is R Q R^T, where R is the derivative by the
/// body-frame motion.
void expect_applied_jacobians_match(const Pose2& start, const Motion& motion) {
  const auto composed = [](const Eigen::VectorXd& in) {
    return (Pose2{in(0), in(1), in(2)} * Pose2{in(3), in(4), in(5)}).vector();
  };
  Eigen::VectorXd in(6);
  in << start.vector(), motion.T_start_end.vector();
  const Eigen::MatrixXd numeric = numeric_jacobian(composed, in, {2});
  const MovedPose moved_pose = apply(start, motion);
  EXPECT_LT(largest_difference(moved_pose.G, numeric.leftCols<3>()), kJacobianTolerance);
  const Eigen::MatrixXd R = numeric.rightCols<3>();
  EXPECT_LT(largest_difference(moved_pose.noise, R * motion.covariance * R.transpose()), kJacobianTolerance);
  EXPECT_EQ(moved_pose.T_map_body, start * motion.T_start_end);
}

TEST(AppliedMotion, JacobiansAtIdentity) { expect_applied_jacobians_match({}, {}); }

TEST(AppliedMotion, JacobiansAtTinyAndRandomMotions) {
  RandomDraws draws(3);
  for (const double extent_m : {1e-6, 10.0})
    for (int i = 0; i < kDraws; ++i) {
      Motion motion;
      motion.T_start_end = draws.pose(extent_m);
      motion.covariance = draws.covariance(3, 0.1);
      expect_applied_jacobians_match(draws.pose(extent_m), motion);
    }
}

}  // namespace
}  // namespace azimuth
