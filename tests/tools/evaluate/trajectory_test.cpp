#include "tools/evaluate/trajectory.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

const std::vector<StampedPose> kTruth{
    {at_s(0.0), {0.0, 0.0, 3.0}}, {at_s(1.0), {2.0, 4.0, -3.0}}, {at_s(2.5), {3.0, 4.0, -3.0}}};

TEST(PoseAt, InterpolatesAcrossOneSecond) {
  const auto pose = pose_at(kTruth, at_s(0.25));
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x_m, 0.5);
  EXPECT_DOUBLE_EQ(pose->y_m, 1.0);
  EXPECT_NEAR(pose->heading_rad, 3.0 + 0.25 * (2 * kPi - 6.0), 1e-12);  // interpolates the short way, across pi
}

TEST(PoseAt, DoesNotBridgeALongerGap) {
  EXPECT_FALSE(pose_at(kTruth, at_s(1.2)));
  EXPECT_TRUE(pose_at(kTruth, at_s(1.2), 2.0));
}

TEST(PoseAt, TakesASampleOfTheSameInstantWhateverTheGap) {
  for (const StampedPose& sample : kTruth) {
    const auto pose = pose_at(kTruth, sample.stamp);
    ASSERT_TRUE(pose);
    EXPECT_EQ(*pose, sample.pose);
  }
}

TEST(PoseAt, DoesNotExtrapolate) {
  EXPECT_FALSE(pose_at(kTruth, at_s(-0.1)));
  EXPECT_FALSE(pose_at(kTruth, at_s(2.6)));
  EXPECT_FALSE(pose_at({}, at_s(0.0)));
}

}  // namespace
}  // namespace azimuth
