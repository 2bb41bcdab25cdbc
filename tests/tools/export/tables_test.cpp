// Tests the export to KITTI and CSV files.

#include <Eigen/Geometry>
#include <array>
#include <gtest/gtest.h>
#include <sstream>
#include <vector>

#include "tests/tools/export/sample.hpp"
#include "tools/export/text_exports.hpp"

namespace azimuth::test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Eigen::Matrix4d kitti_pose(const std::string& line) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  std::istringstream numbers(line);
  for (int i = 0; i < 12; ++i) numbers >> T(i / 4, i % 4);
  EXPECT_TRUE(numbers) << line;
  std::string more;
  EXPECT_FALSE(numbers >> more) << "twelve numbers a line";
  return T;
}

TEST(Kitti, IsTheMapsPoseSeenByACameraThatLooksAhead) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();  // from the axes of the robot to those of the camera
  A(0, 1) = A(1, 2) = -1.0;
  A(2, 0) = A(3, 3) = 1.0;
  const Estimated estimated = sample();
  const std::vector<std::string> lines = lines_of(kitti_text(estimated));
  ASSERT_EQ(lines.size(), estimated.poses.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Pose2& pose = estimated.poses[i].T_map_body;
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    T.topLeftCorner<3, 3>() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T(0, 3) = pose.x_m;
    T(1, 3) = pose.y_m;
    EXPECT_LT((kitti_pose(lines[i]) - A * T * A.transpose()).norm(), 1e-12) << i;
  }
}

TEST(Kitti, BeginsWithTheIdentityWhereTheMapDoes) {
  EXPECT_EQ(lines_of(kitti_text(sample(1))).front(), "1 0 0 0 0 1 0 0 0 0 1 0");
}

TEST(Kitti, TimesAreThoseOfTheLines) {
  const std::vector<std::string> lines = lines_of(kitti_times(sample()));
  ASSERT_EQ(lines.size(), 80u);
  EXPECT_EQ(lines[0], "0.000000");
  EXPECT_EQ(lines[79], "7.900000");
}

TEST(PosesCsv, HasALineForEachPoseWithAllThatIsKnown) {
  Estimated estimated = sample(1);
  EstimatedPose& pose = estimated.poses.front();
  pose.T_map_body = {1.5, -2.25, 0.5};
  pose.T_odom_body = Pose2{3.0, 4.0, -0.125};
  pose.reason = "few, \"if any\"";
  estimated.poses.push_back({stamp_from_us(kSampleBegin_us + 7), {}, Eigen::Matrix3d::Identity(), {}, {}, {}});
  EXPECT_EQ(poses_csv(estimated),
            "t_s,x_m,y_m,heading_rad,var_x_m2,var_y_m2,var_heading_rad2,cov_xy_m2,cov_x_heading_m_rad,"
            "cov_y_heading_m_rad,odom_x_m,odom_y_m,odom_heading_rad,health,reason\n"
            "1700000000.000000,1.5,-2.25,0.5,0.04,0.09,0.01,0.001,0.002,-0.003,3,4,-0.125,starting,"
            "\"few, \"\"if any\"\"\"\n"
            "1700000000.000007,0,0,0,1,1,1,0,0,0,,,,,\n");
}

}  // namespace
}  // namespace azimuth::test
