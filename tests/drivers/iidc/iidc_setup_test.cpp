// Modes, regions of interest, frame rates and bus speed.

#include "drivers/iidc/iidc_setup.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/iidc/iidc_bench.hpp"

namespace azimuth::test {
namespace {

using testing::HasSubstr;

class IidcSetupTest : public IidcBench {
 protected:
  const FrameFormat& format() const { return stream_->description().format; }
  double rate_hz() const { return stream_->description().rate_hz; }
  void offer_format7() { fake().modes[DC1394_VIDEO_MODE_FORMAT7_0] = {}; }
};

TEST_F(IidcSetupTest, AutoTakesTheLargestThenTheMostColourful) {
  const std::vector<dc1394framerate_t> rates{DC1394_FRAMERATE_15};
  fake().modes[DC1394_VIDEO_MODE_1600x1200_MONO16] = rates;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().mode, DC1394_VIDEO_MODE_640x480_MONO8);
  fake().modes[DC1394_VIDEO_MODE_640x480_RGB8] = rates;
  ASSERT_TRUE(open());
  EXPECT_EQ(format(), packed_format(PixelFormat::rgb8, 640, 480));
  fake().modes[DC1394_VIDEO_MODE_640x480_YUV422] = rates;
  ASSERT_TRUE(open());
  EXPECT_EQ(format(), packed_format(PixelFormat::uyvy, 640, 480));
  settings_.wants_colour = false;
  ASSERT_TRUE(open());
  EXPECT_EQ(format(), packed_format(PixelFormat::gray8, 640, 480));
  settings_.wants_colour = true;
  settings_.rate_hz = 30;  // only the small mode and the grey mode reach this rate
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().mode, DC1394_VIDEO_MODE_640x480_MONO8);
  settings_.width_px = 320;
  ASSERT_TRUE(open());
  EXPECT_EQ(format(), packed_format(PixelFormat::uyvy, 320, 240));
  EXPECT_EQ(refused(), "");
}

TEST_F(IidcSetupTest, AWishedModeIsTakenOrRefused) {
  settings_.mode = "320x240_yuv422";
  settings_.width_px = 640;
  settings_.left_px = 8;
  ASSERT_TRUE(open());
  EXPECT_EQ(format(), packed_format(PixelFormat::uyvy, 320, 240));
  EXPECT_THAT(refused(), HasSubstr("mode 320x240_yuv422 has 320x240 only"));
  EXPECT_THAT(refused(), HasSubstr("only Format 7"));
  settings_.mode = "800x600_mono8";
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("does not have mode 800x600_mono8, but 320x240_yuv422, 640x480_mono8"));
  fake().modes[DC1394_VIDEO_MODE_640x480_YUV411] = {DC1394_FRAMERATE_15};
  settings_.mode = "640x480_yuv411";
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("cannot read"));
}

TEST_F(IidcSetupTest, ACameraWithoutAReadableModeIsRefused) {
  fake().modes = {{DC1394_VIDEO_MODE_640x480_MONO16, {DC1394_FRAMERATE_15}}};
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("has no mode that fits; it has 640x480_mono16"));
  fake().modes.clear();
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("it has none"));
  fake().modes = {{DC1394_VIDEO_MODE_640x480_MONO8, {}}};
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("no rate"));
}

TEST_F(IidcSetupTest, TheNearestRateIsTaken) {
  settings_.rate_hz = 14;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().rate, DC1394_FRAMERATE_15);
  EXPECT_EQ(refused(), "rate_hz 14: is 15\n");
  settings_.rate_hz = 7.5;
  ASSERT_TRUE(open());
  EXPECT_EQ(rate_hz(), 7.5);
  EXPECT_EQ(refused(), "");
}

TEST_F(IidcSetupTest, TheSpeedOfTheBusIsSetOnFireWire) {
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().speed, DC1394_ISO_SPEED_400);
  settings_.iso_speed_mbps = 800;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().speed, DC1394_ISO_SPEED_400);
  EXPECT_EQ(refused(), "iso_speed_mbps 800: not supported\n");
  fake().bmode = true;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().speed, DC1394_ISO_SPEED_800);
  EXPECT_EQ(fake().operation, DC1394_OPERATION_MODE_1394B);
  settings_.iso_speed_mbps = 100;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().speed, DC1394_ISO_SPEED_100);
  EXPECT_EQ(fake().operation, DC1394_OPERATION_MODE_LEGACY);
  fake().platform = "usb";
  settings_.iso_speed_mbps = 200;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().speed, DC1394_ISO_SPEED_100);
}

TEST_F(IidcSetupTest, Format7TakesTheWholeSensor) {
  offer_format7();
  settings_.mode = "format7_0";
  ASSERT_TRUE(open()) << trouble_.text;
  EXPECT_EQ(format(), packed_format(PixelFormat::gray8, 1280, 960));
  EXPECT_EQ(fake().format7.packet, fake().format7.packet_recommended);
  EXPECT_DOUBLE_EQ(rate_hz(), 8000.0 / 600);
  EXPECT_EQ(refused(), "");
  fake().send(3);
  ASSERT_EQ(read(), Read::image);
  EXPECT_TRUE(is_filled_with(frame_, 3));
}

TEST_F(IidcSetupTest, RegionsAreRoundedToTheCamerasUnits) {
  offer_format7();
  settings_.mode = "format7_0";
  settings_.left_px = 102;
  settings_.top_px = 51;
  settings_.width_px = 645;
  settings_.height_px = 481;
  ASSERT_TRUE(open()) << trouble_.text;
  EXPECT_EQ(format(), packed_format(PixelFormat::gray8, 640, 480));
  EXPECT_EQ(fake().format7.left, 100U);
  EXPECT_EQ(fake().format7.top, 50U);
  EXPECT_EQ(refused(), "region of interest: is 640x480 at 100, 50\n");
  settings_ = {};
  settings_.mode = "format7_0";
  settings_.left_px = 640;
  settings_.width_px = 640;
  ASSERT_TRUE(open());
  EXPECT_EQ(refused(), "");
}

RC_GTEST_PROP(IidcAxis, EveryChoiceIsPossible, (std::uint16_t size, std::uint16_t place)) {
  iidc::AxisLimits limits;
  limits.largest = *rc::gen::inRange<std::uint32_t>(1, 5000);
  limits.size_unit = *rc::gen::inRange<std::uint32_t>(0, 65);
  limits.place_unit = *rc::gen::inRange<std::uint32_t>(0, 65);
  const iidc::AxisChoice choice = iidc::choose_axis(size, place, limits);
  const std::uint32_t unit = std::max(limits.size_unit, 1U);
  RC_ASSERT(choice.size + choice.place <= limits.largest);
  RC_ASSERT(choice.size % unit == 0U);
  RC_ASSERT(choice.place % std::max(limits.place_unit, 1U) == 0U);
  RC_ASSERT(choice.size > 0U || unit > limits.largest);
  if (size > 0) RC_ASSERT(choice.size <= std::max<std::uint32_t>(size, unit));
  RC_ASSERT(choice.place <= place);
}

TEST(IidcPackets, AreLargeEnoughForTheRate) {
  EXPECT_EQ(iidc::packet_bytes_for(10.0, 640 * 480, 4, 4096), 384U);
  EXPECT_EQ(iidc::packet_bytes_for(10.0, 640 * 480, 5, 4096), 385U);
  EXPECT_EQ(iidc::packet_bytes_for(1000.0, 640 * 480, 4, 4096), 4096U);
  EXPECT_EQ(iidc::packet_bytes_for(1e9, 640 * 480, 0, 4096), 4096U);
  EXPECT_EQ(iidc::packet_bytes_for(0.001, 4, 4, 4096), 4U);
}

TEST_F(IidcSetupTest, RatesOfFormat7ComeFromPacketsOrTheCamera) {
  offer_format7();
  settings_.mode = "format7_0";
  settings_.width_px = 640;
  settings_.height_px = 480;
  settings_.rate_hz = 10;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().format7.packet, 384U);
  EXPECT_EQ(rate_hz(), 10.0);
  EXPECT_EQ(refused(), "");
  settings_.packet_bytes = 1026;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().format7.packet, 1024U);
  EXPECT_THAT(refused(), HasSubstr("packet_bytes 1026: is 1024"));
  EXPECT_THAT(refused(), HasSubstr("rate_hz 10: is 26.67"));
  settings_.packet_bytes = 0;
  fake().format7.interval_s = 0.2F;
  ASSERT_TRUE(open());
  EXPECT_NEAR(rate_hz(), 5.0, 1e-6);
  EXPECT_THAT(refused(), HasSubstr("rate_hz 10: is 5"));
  fake().format7.interval_s = 0.0F;
  fake().features[DC1394_FEATURE_FRAME_RATE].absolute = true;
  ASSERT_TRUE(open());
  EXPECT_FLOAT_EQ(fake().features[DC1394_FEATURE_FRAME_RATE].abs_value, 10.0F);
  EXPECT_EQ(fake().format7.packet, fake().format7.packet_recommended);
  EXPECT_NEAR(rate_hz(), 10.0, 1e-6);
}

TEST_F(IidcSetupTest, OnUsbTheRateOfFormat7MayBeUnknown) {
  offer_format7();
  fake().platform = "usb";
  settings_.mode = "format7_0";
  ASSERT_TRUE(open());
  EXPECT_EQ(rate_hz(), 0.0);
}

TEST_F(IidcSetupTest, RawPixelsFollowTheFilter) {
  offer_format7();
  settings_.mode = "format7_0";
  fake().format7.codings = {DC1394_COLOR_CODING_RAW16, DC1394_COLOR_CODING_MONO8, DC1394_COLOR_CODING_RAW8};
  fake().format7.filter = DC1394_COLOR_FILTER_GRBG;
  fake().format7.unit_left = fake().format7.unit_top = 1;
  settings_.left_px = 3;
  settings_.top_px = 5;
  ASSERT_TRUE(open()) << trouble_.text;
  EXPECT_EQ(format().pixels, PixelFormat::bayer_grbg8);
  EXPECT_EQ(fake().format7.left, 2U);  // keeps the phase of the Bayer pattern
  EXPECT_EQ(fake().format7.top, 4U);
  settings_.wants_colour = false;
  ASSERT_TRUE(open());
  EXPECT_EQ(format().pixels, PixelFormat::gray8);
  settings_.wants_colour = true;
  settings_.colour_coding = "mono8";
  ASSERT_TRUE(open());
  EXPECT_EQ(format().pixels, PixelFormat::gray8);
  settings_.colour_coding = "rgb8";
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("no colour coding that fits; it has raw16, mono8, raw8"));
  settings_.colour_coding = "auto";
  fake().format7.filter = static_cast<dc1394color_filter_t>(0);
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("colour filter"));
  fake().format7.codings.clear();
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("it has none"));
}

TEST_F(IidcSetupTest, ACameraThatAnswersNonsenseIsRefused) {
  offer_format7();
  settings_.mode = "format7_0";
  fake().format7.max_width = 100'000;
  fake().format7.unit_width = 1;
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("images that cannot be"));
  fake().format7.max_width = 0;
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("images that cannot be"));
}

}  // namespace
}  // namespace azimuth::test
