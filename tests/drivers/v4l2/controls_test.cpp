#include <gmock/gmock.h>

#include "drivers/v4l2/v4l2_stream.hpp"
#include "tests/drivers/v4l2/fake_v4l2.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class V4l2ControlsTest : public testing::Test {
 protected:
  /// Opens the camera and returns the refused settings.
  std::vector<std::string> refused(const V4l2Settings& settings) {
    opened_ = OpenedStream{};
    opened_ = open_v4l2(settings, device_);
    EXPECT_TRUE(opened_) << opened_.error().text;
    return opened_ ? (*opened_)->description().refused : std::vector<std::string>{};
  }
  int value(std::uint32_t id) const { return device_.controls.at(id).value; }
  /// Adds the exposure controls of a typical webcam.
  void add_exposure() {
    device_.controls[V4L2_CID_EXPOSURE_AUTO] = {.maximum = 3, .value = 0, .menu = {1, 3}};
    device_.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY] = {.maximum = 1, .value = 1};
    device_.controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {.minimum = 3, .maximum = 2047, .value = 250};
  }

  test::FakeV4l2 device_;
  OpenedStream opened_;
};

TEST_F(V4l2ControlsTest, ACameraWithoutControlsIsNoTrouble) { EXPECT_THAT(refused({}), IsEmpty()); }

TEST_F(V4l2ControlsTest, AutomaticExposureKeepsTheRate) {
  add_exposure();
  EXPECT_THAT(refused({}), IsEmpty());
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_APERTURE_PRIORITY);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 0);
  refused({.exposure_may_lower_rate = true});
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 1);
}

TEST_F(V4l2ControlsTest, FixedValuesTurnTheAutomaticOff) {
  add_exposure();
  device_.controls[V4L2_CID_AUTOGAIN] = {.maximum = 1, .value = 1};
  device_.controls[V4L2_CID_GAIN] = {};
  device_.controls[V4L2_CID_AUTO_WHITE_BALANCE] = {.maximum = 1, .value = 1};
  device_.controls[V4L2_CID_WHITE_BALANCE_TEMPERATURE] = {.minimum = 2000, .maximum = 8000, .value = 4000};
  device_.controls[V4L2_CID_FOCUS_AUTO] = {.maximum = 1, .value = 1};
  device_.controls[V4L2_CID_FOCUS_ABSOLUTE] = {};
  device_.controls[V4L2_CID_POWER_LINE_FREQUENCY] = {.maximum = 2, .menu = {0, 1, 2}};
  EXPECT_THAT(
      refused({.exposure = "100", .gain = "17", .white_balance = "5000", .focus = "3", .power_line = PowerLine::hz50}),
      IsEmpty());
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_ABSOLUTE), 100);
  EXPECT_EQ(value(V4L2_CID_AUTOGAIN), 0);
  EXPECT_EQ(value(V4L2_CID_GAIN), 17);
  EXPECT_EQ(value(V4L2_CID_AUTO_WHITE_BALANCE), 0);
  EXPECT_EQ(value(V4L2_CID_WHITE_BALANCE_TEMPERATURE), 5000);
  EXPECT_EQ(value(V4L2_CID_FOCUS_AUTO), 0);
  EXPECT_EQ(value(V4L2_CID_FOCUS_ABSOLUTE), 3);
  EXPECT_EQ(value(V4L2_CID_POWER_LINE_FREQUENCY), 1);
}

TEST_F(V4l2ControlsTest, WhatIsToBeKeptIsNotTouched) {
  add_exposure();
  EXPECT_THAT(refused({.exposure = "keep", .gain = "keep", .white_balance = "keep"}), IsEmpty());
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), 0);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 1);
}

TEST_F(V4l2ControlsTest, DifferencesAreToldOneSentenceEach) {
  device_.controls[V4L2_CID_GAIN] = {.value = 5, .stubborn = true};
  EXPECT_THAT(refused({.gain = "7"}), ElementsAre("gain is 5, asked for 7"));
  EXPECT_THAT(refused({.gain = "700"}), ElementsAre("gain 700 is beyond its 0 to 255"));
  EXPECT_THAT(refused({.white_balance = "5000", .focus = "2"}),
              ElementsAre("has no white balance that could be set", "has no focus that could be set"));
}

TEST_F(V4l2ControlsTest, CallsThatFailAreToldAndTheCameraRuns) {
  device_.controls[V4L2_CID_GAIN] = {};
  device_.failing[VIDIOC_S_EXT_CTRLS] = EIO;
  EXPECT_THAT(refused({.gain = "7"}), ElementsAre("does not take gain 7: Input/output error"));
  device_.failing.clear();
  device_.failing[VIDIOC_G_EXT_CTRLS] = EACCES;
  EXPECT_THAT(refused({.gain = "7"}), ElementsAre("does not say its gain: Permission denied"));
}

TEST_F(V4l2ControlsTest, AMenuWithoutTheModeIsTold) {
  device_.controls[V4L2_CID_EXPOSURE_AUTO] = {.maximum = 3, .value = 1, .menu = {1}};
  EXPECT_THAT(refused({}), ElementsAre("has no automatic exposure"));
}

}  // namespace
}  // namespace azimuth
