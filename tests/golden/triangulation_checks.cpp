#include <Eigen/LU>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/ekf/triangulation.hpp"
#include "tests/golden/checks.hpp"
#include "tests/golden/state_building.hpp"

namespace azimuth::golden {
namespace {

Matrix6d pose_covariance(const GoldenCase& golden) { return to_matrix(golden.input.at("P6")); }
double sigma_rad(const GoldenCase& golden) { return std::sqrt(golden.input.at("sigma2").get<double>()); }

/// P_LX of the landmark as the joint state stores it when both poses are in the state.
Eigen::MatrixXd cross_covariance_in_state(const GoldenCase& golden, const Intersection& meeting) {
  Eigen::VectorXd poses(6);
  poses << to_vector(golden.input.at("xi")), to_vector(golden.input.at("xj"));
  const std::array blocks{BlockKind::pose};
  BuiltState built = build_state(poses, pose_covariance(golden), blocks);
  const Index landmark = built.state.add(BlockKind::point, meeting.p_map_landmark_m, built.entries, meeting.by_poses,
                                         Eigen::Matrix2d::Zero());
  const std::array<Index, 2> rows{landmark, landmark + 1};
  Eigen::MatrixXd P_LX(2, 6);
  built.state.covariance(rows, built.entries, P_LX);
  return P_LX;
}

}  // namespace

void check_intersect(const GoldenCase& golden) {
  const auto& expected = golden.expected;
  const Sighting i{to_pose(golden.input.at("xi")), golden.input.at("ti")};
  const Sighting j{to_pose(golden.input.at("xj")), golden.input.at("tj")};
  const auto meeting = intersect(i, j);
  ASSERT_TRUE(meeting);
  EXPECT_TRUE(meeting->valid());
  Matrix26d G;
  G << to_matrix(expected.at("Gi")), to_matrix(expected.at("Gj"));
  const Eigen::Vector2d distances(meeting->distance_i_m, meeting->distance_j_m);
  expect_near(meeting->p_map_landmark_m, to_vector(expected.at("xf")), golden.tolerance, "xf");
  expect_near(distances, to_vector(expected.at("ray")), golden.tolerance, "ray parameters");
  expect_near(meeting->by_poses, G, golden.tolerance, "G");
  expect_near(meeting->by_azimuths, to_matrix(expected.at("W")), golden.tolerance, "W");
  expect_near(std::abs(meeting->by_azimuths.determinant()), expected.at("absdetW"), golden.tolerance, "|det W|");
  expect_near(std::asin(std::abs(meeting->sine)), expected.at("parallax"), golden.tolerance, "parallax");
  expect_near(landmark_covariance(*meeting, pose_covariance(golden), sigma_rad(golden)), to_matrix(expected.at("PLL")),
              golden.tolerance, "P_LL");
  expect_near(cross_covariance_in_state(golden, *meeting), to_matrix(expected.at("PLX")), golden.tolerance, "P_LX");
}

void check_intersect_reject(const GoldenCase& golden) {
  const Sighting i{to_pose(golden.input.at("xi")), golden.input.at("ti")};
  const Sighting j{to_pose(golden.input.at("xj")), golden.input.at("tj")};
  const auto meeting = intersect(i, j);
  ASSERT_TRUE(meeting) << "the lines do meet, behind the robot";
  const Eigen::Vector2d distances(meeting->distance_i_m, meeting->distance_j_m);
  expect_near(meeting->p_map_landmark_m, to_vector(golden.expected.at("xf")), golden.tolerance, "xf");
  expect_near(distances, to_vector(golden.expected.at("ray")), golden.tolerance, "ray parameters");
  EXPECT_EQ(meeting->valid(), golden.expected.at("accept").get<bool>());
}

void check_kl(const GoldenCase& golden) {
  const Sighting i{to_pose(golden.input.at("xi")), golden.input.at("zi")};
  const Sighting j{to_pose(golden.input.at("xj")), golden.input.at("zj")};
  const QualityTest thousand(1000);
  const double kl = thousand.relative_entropy(i, j, pose_covariance(golden), sigma_rad(golden));
  expect_near(kl, golden.expected.at("kl1000"), golden.tolerance, "mean of 1000 terms");
  if (!golden.expected.contains("terms16")) return;
  const auto terms = thousand.terms(i, j, pose_covariance(golden), sigma_rad(golden), 16);
  expect_near(Eigen::Map<const Eigen::VectorXd>(terms.data(), static_cast<Eigen::Index>(terms.size())),
              to_vector(golden.expected.at("terms16")), golden.tolerance, "terms");
  const double kl16 = QualityTest(16).relative_entropy(i, j, pose_covariance(golden), sigma_rad(golden));
  expect_near(kl16, golden.expected.at("kl16"), golden.tolerance, "mean of 16 terms");
}

}  // namespace azimuth::golden
