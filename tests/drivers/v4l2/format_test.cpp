#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "drivers/v4l2/v4l2_format.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"

namespace azimuth::v4l2 {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kYuyv = V4L2_PIX_FMT_YUYV, kNv12 = V4L2_PIX_FMT_NV12;

TEST(V4l2Format, KnowsWhatTheFrontEndsRead) {
  EXPECT_EQ(pixel_format(kYuyv), PixelFormat::yuyv);
  EXPECT_EQ(pixel_format(V4L2_PIX_FMT_SBGGR8), PixelFormat::bayer_bggr8);
  EXPECT_EQ(pixel_format(V4L2_PIX_FMT_JPEG), PixelFormat::mjpeg);
  EXPECT_EQ(pixel_format(V4L2_PIX_FMT_SGRBG10), std::nullopt);
  EXPECT_EQ(pixel_format(V4L2_PIX_FMT_H264), std::nullopt);
  EXPECT_EQ(code_text(kYuyv), "YUYV");
  EXPECT_EQ(code_text(V4L2_PIX_FMT_Y16), "Y16_");
}

TEST(V4l2Format, PreferencesCanBeWrittenDown) {
  EXPECT_EQ(parse_formats("YUYV,MJPG"), (std::vector<std::uint32_t>{kYuyv, V4L2_PIX_FMT_MJPEG}));
  EXPECT_EQ(parse_formats("auto"), std::vector<std::uint32_t>{});
  EXPECT_EQ(parse_formats("YUYV,"), std::nullopt);
  EXPECT_EQ(parse_formats("H264"), std::nullopt);
  EXPECT_EQ(parse_formats(""), std::nullopt);
  EXPECT_THAT(known_formats(), HasSubstr("NV12"));
}

TEST(V4l2Format, ColourComesFirstForThoseWhoLookForIt) {
  EXPECT_EQ(preferred_formats(false).front(), V4L2_PIX_FMT_GREY);
  EXPECT_EQ(preferred_formats(true).front(), kYuyv);
  EXPECT_THAT(preferred_formats(true), testing::Not(testing::Contains(V4L2_PIX_FMT_GREY)));
  EXPECT_EQ(preferred_formats(true).size() + 1, preferred_formats(false).size());
}

TEST(V4l2Format, LayoutsThatContradictThemselvesAreNone) {
  EXPECT_EQ(frame_format({kYuyv, 640, 480, 1280, 1280 * 480}), packed_format(PixelFormat::yuyv, 640, 480));
  EXPECT_EQ(frame_format({kYuyv, 640, 480, 0, 1280 * 480}), packed_format(PixelFormat::yuyv, 640, 480));
  EXPECT_EQ(frame_format({kYuyv, 640, 480, 1344, 1344 * 480})->stride_bytes, 1344);
  EXPECT_EQ(frame_format({kNv12, 640, 480, 640, 640 * 720})->bytes(), 640U * 720);
  EXPECT_EQ(frame_format({kNv12, 640, 480, 640, 640 * 480}), std::nullopt);
  EXPECT_EQ(frame_format({kYuyv, 640, 480, 1280, 1280 * 480 - 1}), std::nullopt);
  EXPECT_EQ(frame_format({kYuyv, 640, 480, 640, 1280 * 480}), std::nullopt);
  EXPECT_EQ(frame_format({kYuyv, 641, 480, 1282, 1282 * 480}), std::nullopt);
  EXPECT_EQ(frame_format({kYuyv, 640, 480, 1280, 1280 * 480, V4L2_FIELD_NONE, 2}), std::nullopt);
  EXPECT_EQ(frame_format({V4L2_PIX_FMT_MJPEG, 640, 480, 0, 1}), packed_format(PixelFormat::mjpeg, 640, 480));
}

RC_GTEST_PROP(V4l2Format, WhateverTheDeviceSaysAFrameFitsIntoIt, ()) {
  const ImageLayout layout{*rc::gen::elementOf(preferred_formats(false)),
                           *rc::gen::inRange(-1, 1 << 30),
                           *rc::gen::inRange(-1, 20000),
                           *rc::gen::arbitrary<std::uint32_t>(),
                           *rc::gen::arbitrary<std::uint32_t>(),
                           V4L2_FIELD_NONE,
                           *rc::gen::inRange(0U, 3U)};
  const auto format = frame_format(layout);
  if (!format) return;
  RC_ASSERT(is_valid(*format));
  RC_ASSERT(format->bytes() <= layout.image_bytes);
}

TEST(V4l2Settings, DefaultsAreGoodAndAllMistakesAreNamed) {
  EXPECT_THAT(problems({}), testing::IsEmpty());
  const auto found = problems({.device = "video0", .width_px = 640, .formats = "YUY2", .gain = "12.5", .focus = ""});
  ASSERT_EQ(found.size(), 5U);
  EXPECT_STREQ(found[0].key, "device");
  EXPECT_THAT(found[0].text, HasSubstr("is \"video0\", must be a path"));
  EXPECT_STREQ(found[1].key, "height_px");
  EXPECT_STREQ(found[2].key, "formats");
  EXPECT_THAT(found[2].text, HasSubstr("is \"YUY2\", must be auto or some of"));
  EXPECT_STREQ(found[3].key, "gain");
  EXPECT_THAT(found[3].text, HasSubstr("is \"12.5\", must be auto, keep or a number"));
  EXPECT_STREQ(found[4].key, "focus");
}

TEST(V4l2Settings, ControlChoices) {
  EXPECT_EQ(parse_control_choice("keep"), ControlChoice{});
  EXPECT_EQ(parse_control_choice("auto")->mode, ControlChoice::Mode::automatic);
  EXPECT_EQ(parse_control_choice("-3"), (ControlChoice{ControlChoice::Mode::fixed, -3}));
  EXPECT_EQ(parse_control_choice("3 "), std::nullopt);
  EXPECT_EQ(parse_control_choice("99999999999"), std::nullopt);
}

}  // namespace
}  // namespace azimuth::v4l2
