#pragma once
// Reference values computed outside of this program from the formulas of docs/mathematics.md (golden.json). Numbers
// agree if they differ by at most `tolerance`, relative plus absolute.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "slam/geometry/pose2.hpp"

namespace azimuth::golden {

struct GoldenCase {
  std::string name;
  std::string kind;
  nlohmann::json input;
  nlohmann::json expected;
  double tolerance = 0.0;
};

/// GoogleTest prints the name of a failing case with this operator.
std::ostream& operator<<(std::ostream& out, const GoldenCase& golden);

/// All cases of the file, which is read once. Empty if the file cannot be read.
const std::vector<GoldenCase>& golden_cases();

Eigen::VectorXd to_vector(const nlohmann::json& numbers);
Eigen::MatrixXd to_matrix(const nlohmann::json& rows);
/// Converts [x, y, heading].
Pose2 to_pose(const nlohmann::json& numbers);
std::vector<Eigen::Vector2d> to_points(const nlohmann::json& rows);

/// Adds a test failure with the name `what` if the values differ in shape or by more than the tolerance.
void expect_near(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected, double tolerance,
                 std::string_view what);
void expect_near(double actual, double expected, double tolerance, std::string_view what);

}  // namespace azimuth::golden
