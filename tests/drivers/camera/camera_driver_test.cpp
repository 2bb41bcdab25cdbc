// Recovery of a camera in virtual time.

#include "tests/drivers/camera/camera_driver_fixture.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(CameraDriverTest, HandsImagesOnInOrderWithTheirStamps) {
  run(10s, 100ms);
  EXPECT_TRUE(is(Connection::running));
  ASSERT_EQ(frames_.size(), 100U);
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    EXPECT_EQ(frames_[i].sequence, frames_[i - 1].sequence + 1);
    EXPECT_EQ(frames_[i].stamp - frames_[i - 1].stamp, Duration(100'000));
  }
  EXPECT_EQ(state().images, 100U);
  EXPECT_EQ(state().missing, 0U);
  EXPECT_EQ(device_.opened, 1);
  EXPECT_THAT(events_, ElementsAre("images come from /dev/omnicam (Omni), gray8 4x3"));
}

TEST_F(CameraDriverTest, CountsGapsAndCorruptImagesExactly) {
  run(1s, 100ms);
  sequence_ += 7;
  run(1s, 100ms);
  send(Read::corrupt);
  ++sequence_;
  run(1s, 100ms);
  EXPECT_EQ(state().missing, 7U);
  EXPECT_EQ(state().corrupt, 1U);
  EXPECT_EQ(state().images, 30U);
  EXPECT_EQ(frames_.back().sequence - frames_.front().sequence, 29U + 7 + 1);
}

TEST_F(CameraDriverTest, NoticesSilenceWithinASecondAndOpensAnew) {
  run(1s, 100ms);
  const auto noticed = run_until(5s, [&] { return is(Connection::silent); });
  EXPECT_LT(noticed, 1s);
  EXPECT_GT(noticed, 600ms);
  EXPECT_EQ(state().silences, 1U);
  EXPECT_EQ(state().wants_port_reset, "1-2");
  EXPECT_THAT(state().trouble, HasSubstr("no image for 0.8 s"));
  EXPECT_LT(run_until(1s, [&] { return device_.opened == 2; }), 100ms);
  sequence_ = 0;
  run(1s, 100ms);
  EXPECT_TRUE(is(Connection::running));
  EXPECT_EQ(state().wants_port_reset, "");
  EXPECT_EQ(state().trouble, "");
  EXPECT_EQ(state().reopenings(), 1U);
  EXPECT_EQ(events_.size(), 3U);
}

TEST_F(CameraDriverTest, ASlowCameraIsNotSilentBetweenItsImages) {
  device_.description.rate_hz = 2.0;
  run(20s, 500ms);
  EXPECT_EQ(state().silences, 0U);
  run(1400ms);  // the last image came half a second ago
  EXPECT_TRUE(is(Connection::running));
  run(200ms);
  EXPECT_TRUE(is(Connection::silent));
}

TEST_F(CameraDriverTest, ACameraThatStaysSilentIsToldOnceAndOpenedEverLessOften) {
  run(1s, 100ms);
  run(60s);
  EXPECT_EQ(device_.open_now + 1, 2) << "at most one stream at a time";
  EXPECT_GE(device_.opened, 60 / 4);
  EXPECT_LE(device_.opened, 60 / 3 + 2);
  EXPECT_EQ(events_.size(), 3U) << "running, silent since 0.8 s, no first image for 3 s";
  EXPECT_FALSE(is(Connection::running));
  EXPECT_EQ(state().wants_port_reset, "1-2");
}

TEST_F(CameraDriverTest, OnlyCorruptImagesAreAsGoodAsNone) {
  run(1s, 100ms);
  const auto begun = now_;
  while (!is(Connection::silent) && now_ - begun < 5s) {
    send(Read::corrupt);
    run(50ms);
  }
  EXPECT_LT(now_ - begun, 1s);
  EXPECT_GT(state().corrupt, 10U);
}

TEST_F(CameraDriverTest, SurvivesUnplugAndReplugManyTimes) {
  for (int i = 0; i < 20; ++i) {
    run(1s, 100ms);
    ASSERT_TRUE(is(Connection::running));
    go_away();
    run(100ms * (1 + 7 * i));
    ASSERT_TRUE(is(Connection::away));
    ASSERT_THAT(state().trouble, HasSubstr("No such"));
    ASSERT_EQ(state().wants_port_reset, "");
    come_back();
    const auto begun = now_;
    while (!is(Connection::running) && now_ - begun < 5s) run(100ms, 100ms);
    ASSERT_LT(now_ - begun, 1200ms);
  }
  EXPECT_EQ(state().reopenings(), 20U);
  EXPECT_EQ(state().missing, 0U);
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    ASSERT_GT(frames_[i].sequence, frames_[i - 1].sequence);
    ASSERT_GT(frames_[i].stamp, frames_[i - 1].stamp);
  }
  EXPECT_EQ(events_.size(), 1 + 20U * 3) << "came, and each time failed, could not be opened, came";
}

TEST_F(CameraDriverTest, AHintThatItWasPluggedInIsFollowedAtOnce) {
  run(1s, 100ms);
  go_away();
  run(10s);  // the back-off is now 1 s
  come_back();
  device_.opening = {"/dev/omnicam: open: Permission denied", EACCES};  // udev has not yet set the permissions
  driver_->wake(now_);
  EXPECT_EQ(driver_->due_in(now_), 0s);
  run(500ms);
  device_.opening = {};
  EXPECT_LT(run_until(5s, [&] { return device_.open_now == 1; }), 50ms);
}
TEST_F(CameraDriverTest, ImagesNobodyTakesStayWithTheDevice) {
  turn();
  for (int i = 0; i < 10; ++i) {
    send();
    driver_->turn(now_);
    now_ += 100ms;
  }
  EXPECT_EQ(device_.images.size(), 10 - CameraDriver::kMaxUnread);
  EXPECT_EQ(driver_->descriptor(), -1) << "nothing to wait for";
  Frame frame;
  EXPECT_TRUE(driver_->take(frame));
  EXPECT_NE(driver_->descriptor(), -1);
}

TEST_F(CameraDriverTest, OddStampsAreCountedAndNeverHandedOn) {
  run(1s, 100ms);
  device_.images.push_back({Read::image, sequence_++, stamp() + Duration(5'000'000)});
  turn();
  device_.images.push_back({Read::image, sequence_++, stamp() - Duration(700'000)});
  turn();
  EXPECT_EQ(state().stamps_replaced, 1U);
  EXPECT_EQ(state().stamps_dropped, 1U);
  EXPECT_LE(frames_.back().stamp, stamp());
}

TEST_F(CameraDriverTest, NothingAllocatesWhileImagesCome) {
  run(1s, 100ms);
  Frame frame;
  for (int i = 0; i < 4; ++i, now_ += 1ms) send();
  const std::size_t before = allocations();
  for (int i = 0; i < 100; ++i) {
    now_ += 1ms;
    if (i % 4 == 0) driver_->turn(now_);
    driver_->take(frame);
    driver_->due_in(now_);
  }
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(state().images, 14U);
}

}  // namespace
}  // namespace azimuth
