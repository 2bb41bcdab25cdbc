#include <cmath>
#include <gtest/gtest.h>

#include "slam/geometry/halton.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/rigid_alignment.hpp"
#include "tests/golden/checks.hpp"
#include "tools/evaluate/map_error.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth::golden {
namespace {

Control to_control(const nlohmann::json& u) { return {u.at(0), u.at(1), u.at(2)}; }
Eigen::Vector3d vector_of(const Control& control) {
  return {control.distance_m, control.first_turn_rad, control.second_turn_rad};
}

/// The noise of a parameter set of the paper, with `sigma_m` per metre and `sigma_deg` per full turn (mathematics I.3).
MotionNoise paper_noise(double sigma_m, double sigma_deg) {
  MotionNoise noise;
  noise.lambda_distance_m = sigma_m * sigma_m;
  noise.lambda_rotation_rad = std::pow(degrees_to_rad(sigma_deg), 2) / (2.0 * kPi);
  return noise;
}

void check_lambda_units(const GoldenCase& golden) {
  const MotionNoise set1 = paper_noise(0.05, 5.0), set2 = paper_noise(0.03, 4.0);
  expect_near(set1.lambda_distance_m, golden.expected.at("set1_lambda_d"), golden.tolerance, "set 1, distance");
  expect_near(set1.lambda_rotation_rad, golden.expected.at("set1_lambda_a"), golden.tolerance, "set 1, rotation");
  expect_near(set2.lambda_distance_m, golden.expected.at("set2_lambda_d"), golden.tolerance, "set 2, distance");
  expect_near(set2.lambda_rotation_rad, golden.expected.at("set2_lambda_a"), golden.tolerance, "set 2, rotation");
  const double turn_deg = rad_to_degrees(std::sqrt(control_variances({0.0, kPi / 2.0, 0.0}, set1)(1)));
  expect_near(turn_deg, golden.expected.at("std_90deg_turn_deg_set1"), golden.tolerance, "90 degree turn");
  const double drive_m = std::sqrt(control_variances({1.0, 0.0, 0.0}, set1)(0));
  expect_near(drive_m, golden.expected.at("std_1m_set1"), golden.tolerance, "1 m drive");
}

/// Checks that the second paper's table of errors agrees with its own summary.
void check_table1(const GoldenCase& golden) {
  const auto errors = golden.expected.at("errors").get<std::vector<double>>();
  const ErrorStatistics statistics = error_statistics(errors);
  expect_near(statistics.mean, golden.expected.at("mean"), golden.tolerance, "mean");
  expect_near(statistics.max, golden.expected.at("max"), golden.tolerance, "max");
}

}  // namespace

void check_wrap(const GoldenCase& golden) {
  for (std::size_t i = 0; i < golden.input.size(); ++i)
    expect_near(wrap(golden.input.at(i)), golden.expected.at(i), golden.tolerance, golden.input.at(i).dump());
}

void check_control(const GoldenCase& golden) {
  const Pose2 start = to_pose(golden.input.at("o0")), end = to_pose(golden.input.at("o1"));
  const Control literal = control_between(start, end, /*reverse_driving=*/false);
  expect_near(vector_of(literal), vector_of(to_control(golden.expected.at("u"))), golden.tolerance, "u");
  const Eigen::Vector3d reached = move(start, literal).vector();
  expect_near(reached, golden::to_vector(golden.expected.at("x1_check")), golden.tolerance, "x1");
  if (!golden.expected.contains("u_reverse")) return;
  const Control reverse = control_between(start, end, /*reverse_driving=*/true);
  expect_near(vector_of(reverse), vector_of(to_control(golden.expected.at("u_reverse"))), golden.tolerance,
              "u reverse");
  expect_near(move(start, reverse).vector(), reached, golden.tolerance, "x1 reverse");
}

void check_motion(const GoldenCase& golden) {
  const auto& expected = golden.expected;
  const Pose2 start = to_pose(golden.input.at("x"));
  const Control control = to_control(golden.input.at("u"));
  MotionNoise noise;
  noise.lambda_distance_m = golden.input.at("lambda_d");
  noise.lambda_rotation_rad = golden.input.at("lambda_a");
  const MotionJacobians jacobians = motion_jacobians(start.heading_rad, control);
  expect_near(move(start, control).vector(), golden::to_vector(expected.at("x1")), golden.tolerance, "x1");
  expect_near(jacobians.G, to_matrix(expected.at("G")), golden.tolerance, "G");
  expect_near(jacobians.V, to_matrix(expected.at("V")), golden.tolerance, "V");
  const Eigen::Matrix4d control_covariance = control_variances(control, noise).asDiagonal();
  expect_near(control_covariance, to_matrix(expected.at("Qu")), golden.tolerance, "Qu");
  const Eigen::Matrix3d Q = motion_noise(start.heading_rad, control, noise);
  expect_near(Q, to_matrix(expected.at("Qpose")), golden.tolerance, "Qpose");
  const Eigen::Matrix3d P = to_matrix(golden.input.at("P"));
  expect_near(jacobians.G * P * jacobians.G.transpose() + Q, to_matrix(expected.at("P1")), golden.tolerance, "P1");

  // The same step through the accumulated motion, as the estimator computes it.
  Motion motion;
  append(motion, control, control, noise);
  const MovedPose moved = apply(start, motion);
  expect_near(moved.T_map_body.vector(), golden::to_vector(expected.at("x1")), golden.tolerance, "x1 of apply");
  expect_near(moved.G * P * moved.G.transpose() + moved.noise, to_matrix(expected.at("P1")), golden.tolerance,
              "P1 of apply");
}

void check_const(const GoldenCase& golden) {
  if (golden.name == "lambda_units") return check_lambda_units(golden);
  if (golden.name == "table1_check") return check_table1(golden);
  FAIL() << "unknown constants: " << golden.name;
}

void check_halton(const GoldenCase& golden) {
  const auto points = halton_normal_8d(golden.input.at("n"));
  ASSERT_EQ(points.size(), golden.expected.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    expect_near(points[k], golden::to_vector(golden.expected.at(k)), golden.tolerance,
                "point " + std::to_string(k + 1));
}

void check_align(const GoldenCase& golden) {
  const auto from = to_points(golden.input.at("A")), to = to_points(golden.input.at("B"));
  const Pose2 T_to_from = align(from, to);
  for (std::size_t i = 0; i < from.size(); ++i)
    expect_near((T_to_from * from[i] - to[i]).norm(), golden.expected.at("residuals").at(i), golden.tolerance,
                "residual " + std::to_string(i));
}

void check_pairdist(const GoldenCase& golden) {
  const auto a = to_points(golden.input.at("A")), b = to_points(golden.input.at("B"));
  const PairDistanceError error = pair_distance_error(a, b);
  expect_near(error.sum_squared_m2, golden.expected.at("sum_sq"), golden.tolerance, "sum of squares");
  expect_near(error.rms_m, golden.expected.at("rms"), golden.tolerance, "rms");
}

}  // namespace azimuth::golden
