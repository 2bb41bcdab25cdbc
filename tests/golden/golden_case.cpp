#include "tests/golden/golden_case.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

namespace azimuth::golden {
namespace {

using nlohmann::json;

std::vector<GoldenCase> read_cases(const char* path) {
  std::ifstream file(path);
  const json document = json::parse(file, nullptr, /*allow_exceptions=*/false);
  std::vector<GoldenCase> cases;
  if (document.is_discarded()) return cases;
  for (const json& entry : document.at("cases"))
    cases.push_back({entry.at("name"), entry.at("kind"), entry.at("input"), entry.at("expected"), entry.at("tol")});
  return cases;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const GoldenCase& golden) {
  return out << golden.kind << " / " << golden.name;
}

const std::vector<GoldenCase>& golden_cases() {
  static const std::vector<GoldenCase> cases = read_cases(AZIMUTH_GOLDEN_FILE);
  return cases;
}

Eigen::VectorXd to_vector(const json& numbers) {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) vector(static_cast<Eigen::Index>(i)) = numbers.at(i).get<double>();
  return vector;
}

Eigen::MatrixXd to_matrix(const json& rows) {
  if (rows.empty()) return {};
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.at(0).size()));
  for (std::size_t r = 0; r < rows.size(); ++r)
    matrix.row(static_cast<Eigen::Index>(r)) = to_vector(rows.at(r)).transpose();
  return matrix;
}

Pose2 to_pose(const json& numbers) { return {numbers.at(0), numbers.at(1), numbers.at(2)}; }

std::vector<Eigen::Vector2d> to_points(const json& rows) {
  std::vector<Eigen::Vector2d> points;
  for (const json& row : rows) points.emplace_back(row.at(0).get<double>(), row.at(1).get<double>());
  return points;
}

void expect_near(double actual, double expected, double tolerance, std::string_view what) {
  EXPECT_NEAR(actual, expected, tolerance * (1.0 + std::abs(expected))) << what;
}

void expect_near(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected, double tolerance,
                 std::string_view what) {
  ASSERT_EQ(actual.rows(), expected.rows()) << what;
  ASSERT_EQ(actual.cols(), expected.cols()) << what;
  for (Eigen::Index c = 0; c < actual.cols(); ++c)
    for (Eigen::Index r = 0; r < actual.rows(); ++r)
      EXPECT_NEAR(actual(r, c), expected(r, c), tolerance * (1.0 + std::abs(expected(r, c))))
          << what << " (" << r << ", " << c << ")";
}

}  // namespace azimuth::golden
