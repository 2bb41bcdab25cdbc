// The odometer's memory from one process to the next, for odometry over LCM.

#include "tests/drivers/lcm/lcm_odometry_fixture.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// The memory after two seconds of odometry.
class LcmOdometryMemory : public LcmOdometryTest {
 protected:
  LcmOdometryMemory() {
    for (int i = 0; i < 20; ++i) send(reading(100 + i, 0.05 * i));
    before_ = taken().back();
    remembers_ = odometry_.remember(memory_);
  }
  /// The first reading of the next process. The robot has continued to send meanwhile.
  OdometryReading first_heard(LcmPeer sender, double x_m, std::int64_t origin = 3, Duration away = 3s) {
    LcmOdometry next(settings_);
    next.restore(memory_);
    now_ += away;
    odometry_t message = reading(160, x_m);
    message.origin = static_cast<std::int32_t>(origin);
    encode(message, encoded_);
    test::offer(next, test::whole_message(0, "ODOMETRY", encoded_), sender, {now_ + 5ms, {}});
    OdometryReading heard;
    EXPECT_TRUE(next.take(heard));
    EXPECT_EQ(next.counts().missing, 0U);
    return heard;
  }
  OdometerMemory memory_;
  OdometryReading before_;
  bool remembers_ = false;
};

TEST_F(LcmOdometryMemory, LetsTheNextProcessGoOnWithTheSameSender) {
  ASSERT_TRUE(remembers_);
  const OdometryReading heard = first_heard(kLcmRobot, 2.5);
  EXPECT_EQ(heard.origin, before_.origin);
  EXPECT_EQ(heard.T_odom_body.x_m, 2.5);
  EXPECT_NEAR(heard.sigma_gap_m, 0.15, 0.02) << "nobody knows the way it took";
}

TEST_F(LcmOdometryMemory, IsHandedOnByAProcessThatHeardNothing) {
  LcmOdometry deaf(settings_);
  deaf.restore(memory_);
  OdometerMemory again;
  ASSERT_TRUE(deaf.remember(again));
  EXPECT_EQ(again, memory_);
}

TEST_F(LcmOdometryMemory, IsNotBelievedOfAnotherSenderOrOneThatRestarted) {
  EXPECT_EQ(first_heard(kOtherLcmRobot, 2.5).origin, before_.origin + 1);
  EXPECT_EQ(first_heard(kLcmRobot, 2.5, 4).origin, before_.origin + 1);
  EXPECT_EQ(first_heard(kLcmRobot, 500.0).origin, before_.origin + 1);
  memory_.odometer = "lcm ANOTHER";
  EXPECT_EQ(first_heard(kLcmRobot, 2.5).origin, before_.origin + 1);
}

TEST(LcmOdometryWithoutASender, RemembersNothing) {
  const LcmOdometry odometry(LcmSourceSettings{});
  OdometerMemory memory;
  EXPECT_FALSE(odometry.remember(memory));
}

}  // namespace
}  // namespace azimuth
