// Opening a camera that is absent, fails, is slow or has other properties than requested, in virtual time.

#include "tests/drivers/camera/camera_driver_fixture.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(CameraDriverTest, AnAbsentCameraIsAskedForEverMoreSeldomAndToldOnce) {
  int asked = 0;
  driver_ = std::make_unique<CameraDriver>(CameraDriverSettings{}, [&]() -> OpenedStream {
    ++asked;
    return tl::unexpected(CameraTrouble{"/dev/omnicam: open: No such file or directory", ENOENT});
  });
  run(60s);
  EXPECT_LT(asked, 150);
  asked = 0;
  run(60s);
  EXPECT_GT(asked, 55);
  EXPECT_LT(asked, 65);
  EXPECT_EQ(driver_->descriptor(), -1);
  EXPECT_THAT(events_, ElementsAre(HasSubstr("No such file")));
}

TEST_F(CameraDriverTest, ACameraThatAnswersInVainWantsItsPortReset) {
  run(1s, 100ms);
  send(Read::failed);
  device_.opening = {"/dev/omnicam: VIDIOC_S_FMT: Connection timed out", ETIMEDOUT};
  run(20ms);
  EXPECT_EQ(state().wants_port_reset, "") << "opening it anew may help";
  run(2s);
  EXPECT_EQ(state().wants_port_reset, "1-2");
  device_.opening = {"/dev/omnicam: open: No such device", ENODEV};
  run(2s);
  EXPECT_EQ(state().wants_port_reset, "") << "it left";
}

TEST_F(CameraDriverTest, AnOpenerMayTakeItsTime) {
  device_.still_opening = true;
  run(5s);
  EXPECT_THAT(events_, IsEmpty());
  EXPECT_LE(driver_->due_in(now_), 10ms);
  device_.still_opening = false;
  run(1s, 100ms);
  EXPECT_TRUE(is(Connection::running));
}

TEST_F(CameraDriverTest, TheTimeAnOpeningBlocksIsNotSilence) {
  driver_ = std::make_unique<CameraDriver>(CameraDriverSettings{}, [&]() -> OpenedStream {
    now_ += 10s;
    return device_.opener()();
  });
  turn();
  EXPECT_EQ(driver_->due_in(now_), 0s);
  turn();
  EXPECT_TRUE(is(Connection::starting));
  send();
  turn();
  EXPECT_TRUE(is(Connection::running));
  EXPECT_EQ(state().stamps_replaced + state().stamps_dropped, 0U);
}

TEST_F(CameraDriverTest, AnotherSizeThanTheRigsIsRefusedWithASentence) {
  start({.width_px = 640, .height_px = 480});
  run(10s);
  EXPECT_TRUE(is(Connection::away));
  EXPECT_EQ(device_.open_now, 0);
  EXPECT_THAT(events_, ElementsAre("/dev/omnicam: gives images of 4x3, the rig's camera has 640x480"));
}

TEST_F(CameraDriverTest, RefusedSettingsAreToldOnceForAllOpenings) {
  device_.description.refused = {"gain is 5, asked for 7", "has no focus"};
  run(1s, 100ms);
  go_away();
  run(100ms);
  come_back();
  run(2s, 100ms);
  EXPECT_TRUE(is(Connection::running));
  EXPECT_EQ(std::ranges::count(events_, "/dev/omnicam: gain is 5, asked for 7"), 1);
  EXPECT_EQ(std::ranges::count(events_, "/dev/omnicam: has no focus"), 1);
}
}  // namespace
}  // namespace azimuth
