#include <gtest/gtest.h>

#include "slam/estimator/estimator_stage.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// A metre straight on, with standard deviations of 2 cm and 0.02 rad.
Motion metre() {
  Motion motion{.T_start_end = {1.0, 0.0, 0.0}, .path_m = 1.0};
  motion.covariance.diagonal() << 4e-4, 4e-4, 4e-4;
  return motion;
}

PoseBelief at(double x_m, double y_m = 0.0) { return {{x_m, y_m, 0.0}, 1e-4 * Eigen::Matrix3d::Identity()}; }

class DeadReckoningTest : public testing::Test {
 protected:
  DeadReckoningTest() { reckoning_.begin(Stamp{Duration{7}}, at(0.0)); }
  DeadReckoning reckoning_;
};

TEST_F(DeadReckoningTest, SumsUpTheWaySinceTheMap) {
  reckoning_.add(metre(), at(1.02), Health::tracking);
  reckoning_.add(metre(), at(1.99), Health::degraded);
  const auto motion = reckoning_.motion();
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->T_start_end, (Pose2{2.0, 0.0, 0.0}));
  EXPECT_NEAR(motion->covariance(0, 0), 8e-4, 1e-12);
  EXPECT_NEAR(motion->covariance(1, 1), 8e-4 + 4e-4, 1e-12) << "the first metre's turn has a lever of a metre";
  EXPECT_EQ(motion->path_m, 2.0);
  EXPECT_EQ(reckoning_.map(), Stamp{Duration{7}});
}

TEST_F(DeadReckoningTest, EndsWhenTheRobotWasLost) {
  reckoning_.add(metre(), at(1.0), Health::lost);
  reckoning_.add(metre(), at(2.0), Health::tracking);
  EXPECT_FALSE(reckoning_.motion());
  reckoning_.begin(Stamp{}, at(2.0));
  EXPECT_TRUE(reckoning_.motion()) << "until the next map";
}

TEST_F(DeadReckoningTest, EndsWhenItDoesNotLeadToWhereTheRobotIs) {
  reckoning_.add(metre(), at(0.8), Health::tracking);
  EXPECT_FALSE(reckoning_.motion()) << "wheels that spun for 0.2 m";
}

TEST_F(DeadReckoningTest, IsOfNoUseOnceItIsVague) {
  Motion blind = metre();
  blind.covariance(2, 2) = 0.2;
  reckoning_.add(blind, at(1.0), Health::degraded);
  EXPECT_FALSE(reckoning_.motion());
}

TEST(DeadReckoningWithoutAMap, SaysNothing) {
  DeadReckoning reckoning;
  reckoning.add(metre(), at(1.0), Health::tracking);
  EXPECT_FALSE(reckoning.motion());
}

}  // namespace
}  // namespace azimuth
