#include "tools/import/wheel_path.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace azimuth::test {
namespace {

TEST(WheelPath, BeginsWhereItIsFirstTold) {
  WheelPath path(0.5);
  EXPECT_EQ(path.at(17.0, -3.0), Pose2{});
  const Pose2 pose = path.at(18.0, -2.0);
  EXPECT_NEAR(pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(pose.heading_rad, 0.0, 1e-12);
}

TEST(WheelPath, DrivesACircleInOneStepAsInMany) {
  constexpr double kApart_m = 0.4, kRadius_m = 2.0;
  const auto wheels = [](double turned_rad) {
    return std::pair{(kRadius_m - kApart_m / 2) * turned_rad, (kRadius_m + kApart_m / 2) * turned_rad};
  };
  WheelPath one(kApart_m), many(kApart_m);
  one.at(0.0, 0.0);
  const auto [left, right] = wheels(kPi / 2);
  const Pose2 end = one.at(left, right);
  EXPECT_NEAR(end.x_m, kRadius_m, 1e-12);
  EXPECT_NEAR(end.y_m, kRadius_m, 1e-12);
  EXPECT_NEAR(end.heading_rad, kPi / 2, 1e-12);
  Pose2 pose;
  for (int i = 0; i <= 100; ++i) {
    const auto [l, r] = wheels(kPi / 2 * i / 100);
    pose = many.at(l, r);
  }
  EXPECT_NEAR(pose.x_m, end.x_m, 1e-9);
  EXPECT_NEAR(pose.y_m, end.y_m, 1e-9);
}

TEST(HeadingOfAQuaternion, IsThatOfARotationAboutTheVertical) {
  for (const double heading_rad : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const auto read = heading_of(0.0, 0.0, std::sin(heading_rad / 2), std::cos(heading_rad / 2));
    ASSERT_TRUE(read);
    EXPECT_NEAR(*read, heading_rad, 1e-12);
    const auto rounded = heading_of(0.0, 0.0, -1.001 * std::sin(heading_rad / 2), -1.001 * std::cos(heading_rad / 2));
    ASSERT_TRUE(rounded);
    EXPECT_NEAR(*rounded, heading_rad, 1e-12) << "its length and its sign do not matter";
  }
}

TEST(HeadingOfAQuaternion, RefusesWhatIsNoRotation) {
  EXPECT_FALSE(heading_of(0.0, 0.0, 0.0, 0.0));
  EXPECT_FALSE(heading_of(0.0, 0.0, 1.0, 1.0));
  EXPECT_FALSE(heading_of(0.0, 0.0, 0.0, std::nan("")));
}

}  // namespace
}  // namespace azimuth::test
