// Camera features such as exposure and gain.

#include <gmock/gmock.h>

#include "tests/drivers/iidc/iidc_bench.hpp"

namespace azimuth::test {
namespace {

class IidcFeatureTest : public IidcBench {
 protected:
  FakeFeature& offer(dc1394feature_t id) { return fake().features[id] = FakeFeature{}; }
};

TEST_F(IidcFeatureTest, WithoutAWishNothingIsTouched) {
  FakeFeature& gain = offer(DC1394_FEATURE_GAIN);
  gain.on = false;
  gain.switchable = true;
  ASSERT_TRUE(open());
  EXPECT_FALSE(gain.on);
  EXPECT_EQ(gain.mode, DC1394_FEATURE_MODE_AUTO);
  EXPECT_EQ(gain.value, 100U);
}

TEST_F(IidcFeatureTest, ValuesAreSetAndReadBack) {
  FakeFeature& shutter = offer(DC1394_FEATURE_SHUTTER);
  shutter.uses_absolute = shutter.absolute = true;
  FakeFeature& gain = offer(DC1394_FEATURE_GAIN);
  gain.mode = DC1394_FEATURE_MODE_MANUAL;
  FakeFeature& exposure = offer(DC1394_FEATURE_EXPOSURE);
  exposure.absolute = true;
  FakeFeature& white = offer(DC1394_FEATURE_WHITE_BALANCE);
  FakeFeature& focus = offer(DC1394_FEATURE_FOCUS);
  focus.switchable = true;
  focus.on = false;
  FakeFeature& gamma = offer(DC1394_FEATURE_GAMMA);
  gamma.switchable = true;
  settings_.shutter = "250";
  settings_.gain = "auto";
  settings_.exposure = "1.5 EV";
  settings_.white_balance = "512 480";
  white.max = 1023;
  settings_.focus = "70";
  settings_.gamma = "off";
  ASSERT_TRUE(open());
  EXPECT_EQ(refused(), "");
  EXPECT_EQ(shutter.value, 250U);
  EXPECT_FALSE(shutter.uses_absolute);
  EXPECT_EQ(shutter.mode, DC1394_FEATURE_MODE_MANUAL);
  EXPECT_EQ(gain.mode, DC1394_FEATURE_MODE_AUTO);
  EXPECT_TRUE(exposure.uses_absolute);
  EXPECT_FLOAT_EQ(exposure.abs_value, 1.5F);
  EXPECT_EQ(white.value, 512U);
  EXPECT_EQ(white.second_value, 480U);
  EXPECT_TRUE(focus.on);
  EXPECT_EQ(focus.value, 70U);
  EXPECT_FALSE(gamma.on);
}

TEST_F(IidcFeatureTest, WhatTheCameraCannotDoIsTold) {
  FakeFeature& gain = offer(DC1394_FEATURE_GAIN);
  gain.automatic = false;
  offer(DC1394_FEATURE_FOCUS).max = 90;
  offer(DC1394_FEATURE_SHUTTER);
  FakeFeature& sharpness = offer(DC1394_FEATURE_SHARPNESS);
  sharpness.step = 16;
  FakeFeature& exposure = offer(DC1394_FEATURE_EXPOSURE);
  exposure.absolute = true;
  offer(DC1394_FEATURE_GAMMA);
  offer(DC1394_FEATURE_WHITE_BALANCE).max = 500;
  settings_.gain = "auto";
  settings_.focus = "100";
  settings_.shutter = "4 ms";
  settings_.sharpness = "100";
  settings_.exposure = "12 EV";
  settings_.gamma = "off";
  settings_.white_balance = "600 400";
  settings_.brightness = "5";
  ASSERT_TRUE(open());
  EXPECT_THAT(
      stream_->description().refused,
      testing::UnorderedElementsAre(
          "gain \"auto\": the camera cannot do it automatically", "focus \"100\": is 90; the camera has 0 to 90",
          "shutter \"4 ms\": the camera has no absolute values for it, only its register's",
          "sharpness \"100\": is 96; the camera has 0 to 1000", "exposure \"12 EV\": is 10; the camera has 0 to 10",
          "gamma \"off\": the camera cannot switch it off", "white_balance \"600 400\": is 500 400",
          "brightness \"5\": the camera does not have it"));
}

}  // namespace
}  // namespace azimuth::test
