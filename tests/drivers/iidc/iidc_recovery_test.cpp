// Recovery of a camera by the driver after it disappears.

#include <chrono>
#include <gmock/gmock.h>

#include "drivers/camera/camera_driver.hpp"
#include "tests/drivers/iidc/iidc_bench.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

class IidcRecoveryTest : public IidcBench {
 protected:
  IidcRecoveryTest() : driver_({}, [this] { return open_iidc(settings_); }) {}

  /// Advances the driver's clock, which is independent of the stamps. If it runs too far ahead, images become too old.
  void turn(CameraDriver::Clock::duration later = 1ms) { driver_.turn(now_ += later); }
  /// Sends a frame and returns whether the driver delivers it.
  bool passes(std::uint8_t number) {
    fake().send(number, -(++sent_ * 33'333));
    turn();
    return driver_.take(frame_) && is_filled_with(frame_, number);
  }
  /// Calls the driver until the camera is open, at most for 2 s.
  bool comes_back() {
    for (int i = 0; i < 200 && fake().captures == 0; ++i) turn(10ms);
    return fake().captures == 1;
  }
  std::string events() {
    std::string all, event;
    while (driver_.take_event(event)) all += event + "\n";
    return all;
  }

  CameraDriver::Clock::time_point now_ = CameraDriver::Clock::now();
  std::int64_t sent_ = 0;
  CameraDriver driver_;
};

TEST_F(IidcRecoveryTest, UnpluggedAndPluggedInAgain) {
  turn();
  ASSERT_TRUE(passes(1));
  for (std::uint8_t round = 1; round <= 10; ++round) {
    fake().dequeue_error = DC1394_FAILURE;
    fake().guids.clear();
    turn();
    EXPECT_EQ(driver_.state().connection, Connection::away);
    EXPECT_EQ(fake().captures, 0);
    turn(60ms);  // one failed attempt
    fake().dequeue_error = DC1394_SUCCESS;
    fake().guids = {FakeIidc::kGuid};
    driver_.wake(now_);
    ASSERT_TRUE(comes_back()) << driver_.state().trouble;
    const std::uint64_t before = frame_.sequence;
    ASSERT_TRUE(passes(round));
    EXPECT_GT(frame_.sequence, before + 1);  // the gap in the sequence tells followers that images were lost
  }
  EXPECT_EQ(driver_.state().reopenings(), 10U);
  EXPECT_THAT(events(), testing::HasSubstr("is not there"));
}

TEST_F(IidcRecoveryTest, ABusResetCostsAReopening) {
  turn();
  ASSERT_TRUE(passes(1));
  fake().reset_bus();
  turn();
  ASSERT_TRUE(comes_back());
  EXPECT_TRUE(passes(2));
  EXPECT_THAT(events(), testing::HasSubstr("the bus was reset"));
}

TEST_F(IidcRecoveryTest, ASilentCameraIsOpenedAnew) {
  turn();
  ASSERT_TRUE(passes(1));
  for (int i = 0; i < 99 && driver_.state().silences == 0; ++i) turn(10ms);
  EXPECT_EQ(driver_.state().silences, 1U);
  ASSERT_TRUE(comes_back());
  EXPECT_TRUE(passes(2));
}

TEST_F(IidcRecoveryTest, ALeaseFromBeforeDoesNotKeepTheCameraAway) {
  turn();
  ASSERT_TRUE(passes(9));
  const Frame held = std::move(frame_);
  fake().reset_bus();
  turn();
  ASSERT_TRUE(comes_back());
  EXPECT_TRUE(passes(2));
  EXPECT_TRUE(is_filled_with(held, 9));
}

TEST_F(IidcRecoveryTest, CorruptFramesAreNotMissingOnes) {
  turn();
  ASSERT_TRUE(passes(1));
  fake().send(2, -(++sent_ * 33'333), true);
  turn();
  ASSERT_TRUE(passes(3));
  EXPECT_EQ(driver_.state().corrupt, 1U);
  EXPECT_EQ(driver_.state().missing, 0U);
}

}  // namespace
}  // namespace azimuth::test
