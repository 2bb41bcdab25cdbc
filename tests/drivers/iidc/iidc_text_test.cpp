#include "drivers/iidc/iidc_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "drivers/iidc/iidc_modes.hpp"

namespace azimuth::iidc {
namespace {

using Kind = FeatureWish::Kind;

TEST(IidcText, FeaturesAreWordsRegistersOrAbsoluteValues) {
  EXPECT_EQ(parse_feature("keep", FeatureUnit::none)->kind, Kind::keep);
  EXPECT_EQ(parse_feature(" auto ", FeatureUnit::none)->kind, Kind::automatic);
  EXPECT_EQ(parse_feature("off", FeatureUnit::none)->kind, Kind::off);
  const auto value = parse_feature("4095", FeatureUnit::second);
  ASSERT_TRUE(value.has_value());
  EXPECT_EQ(value->kind, Kind::value);
  EXPECT_EQ(value->value, 4095U);
  const auto time = parse_feature("4.5 ms", FeatureUnit::second);
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(time->kind, Kind::absolute);
  EXPECT_DOUBLE_EQ(time->absolute, 0.0045);
  EXPECT_DOUBLE_EQ(parse_feature("-3dB", FeatureUnit::decibel)->absolute, -3.0);
}

TEST(IidcText, FeaturesWithAnotherUnitOrNonsenseAreRefused) {
  for (const char* text :
       {"4096", "-1", "4.5", "4 dB", "4 m", "ms", "nan s", "inf s", "1e999 s", "12 ", "1 2 s", "AUTO"}) {
    const bool good = std::string_view(text) == "12 ";  // surrounding spaces are ignored
    EXPECT_EQ(parse_feature(text, FeatureUnit::second).has_value(), good) << text;
  }
  EXPECT_FALSE(parse_feature("4 ms", FeatureUnit::none).has_value());
}

TEST(IidcText, WhiteBalanceIsTwoRegisters) {
  const auto pair = parse_white_balance("512  480");
  ASSERT_TRUE(pair.has_value());
  EXPECT_EQ(pair->kind, Kind::pair);
  EXPECT_EQ(pair->value, 512U);
  EXPECT_EQ(pair->second_value, 480U);
  EXPECT_EQ(parse_white_balance("auto")->kind, Kind::automatic);
  for (const char* text : {"512", "512,480", "1 2 3", "1 5000", "x y"})
    EXPECT_FALSE(parse_white_balance(text).has_value()) << text;
}

RC_GTEST_PROP(IidcText, EveryGuidSurvivesItsText, (std::uint64_t guid)) {
  RC_ASSERT(parse_guid(guid_text(guid)) == guid);
  RC_ASSERT(guid_text(guid).size() == 16U);
}

TEST(IidcText, GuidsAreHexadecimal) {
  EXPECT_EQ(parse_guid("0x00B09D0100c0ffee"), 0x00b09d0100c0ffeeU);
  EXPECT_EQ(parse_guid("1"), 1U);
  for (const char* text : {"", "0x", "-1", "g", "00b09d0100c0ffee0", "12 "})
    EXPECT_FALSE(parse_guid(text).has_value()) << text;
}

RC_GTEST_PROP(IidcText, AnyTextIsSafe, (const std::string& text)) {
  for (const FeatureText& feature : kFeatureTexts) {
    IidcSettings settings;
    settings.*feature.text = text;
    const auto wish = parse(feature, settings);
    const auto problem = problem_of(settings);
    RC_ASSERT(wish.has_value() == !problem.has_value());
    if (problem) RC_ASSERT(problem->key == feature.name);
  }
}

TEST(IidcModes, NamesLeadBackToTheirModes) {
  int modes = 0;
  for (int number = DC1394_VIDEO_MODE_MIN; number <= DC1394_VIDEO_MODE_MAX; ++number) {
    const auto mode = static_cast<dc1394video_mode_t>(number);
    if (mode == DC1394_VIDEO_MODE_EXIF) continue;
    EXPECT_EQ(mode_named(mode_name(mode)), mode) << mode_name(mode);
    EXPECT_NE(fixed_mode(mode).has_value(), is_format7(mode));
    ++modes;
  }
  EXPECT_EQ(modes, 31);
  EXPECT_EQ(mode_name(DC1394_VIDEO_MODE_1024x768_RGB8), "1024x768_rgb8");
  EXPECT_EQ(mode_name(DC1394_VIDEO_MODE_FORMAT7_3), "format7_3");
  EXPECT_EQ(mode_name(DC1394_VIDEO_MODE_EXIF), "");
  EXPECT_FALSE(mode_named("").has_value());
  EXPECT_FALSE(mode_named("640x480").has_value());
}

TEST(IidcModes, OnlyCodingsOfEightBitsAreReadable) {
  using testing::ElementsAre;
  std::vector<std::string> readable;
  for (int number = DC1394_COLOR_CODING_MIN; number <= DC1394_COLOR_CODING_MAX; ++number) {
    const auto coding = static_cast<dc1394color_coding_t>(number);
    EXPECT_EQ(coding_named(coding_name(coding)), coding);
    if (is_readable(coding)) readable.push_back(coding_name(coding));
    EXPECT_EQ(pixels_of(coding).has_value(), is_readable(coding) && coding != DC1394_COLOR_CODING_RAW8);
  }
  EXPECT_THAT(readable, ElementsAre("mono8", "yuv422", "rgb8", "raw8"));
  EXPECT_EQ(pixels_of(DC1394_COLOR_CODING_YUV422), PixelFormat::uyvy);
  EXPECT_EQ(pixels_of(DC1394_COLOR_FILTER_GBRG), PixelFormat::bayer_gbrg8);
  EXPECT_EQ(rate_hz_of(DC1394_FRAMERATE_1_875), 1.875);
  EXPECT_EQ(rate_hz_of(DC1394_FRAMERATE_240), 240.0);
}

TEST(IidcText, SettingsNoCameraCouldHaveAreNamed) {
  const auto key = [](auto change) {
    IidcSettings settings;
    change(settings);
    const auto problem = problem_of(settings);
    return problem ? std::string(problem->key) : "";
  };
  EXPECT_EQ(key([](IidcSettings&) {}), "");
  EXPECT_EQ(key([](IidcSettings& s) { s.guid = "x"; }), "guid");
  EXPECT_EQ(key([](IidcSettings& s) { s.mode = "640x480_mono9"; }), "mode");
  EXPECT_EQ(key([](IidcSettings& s) { s.colour_coding = "mono16"; }), "colour_coding");
  EXPECT_EQ(key([](IidcSettings& s) { s.colour_coding = "red"; }), "colour_coding");
  EXPECT_EQ(key([](IidcSettings& s) { s.iso_speed_mbps = 300; }), "iso_speed_mbps");
  EXPECT_EQ(key([](IidcSettings& s) { s.white_balance = "5"; }), "white_balance");
  EXPECT_EQ(key([](IidcSettings& s) { s.shutter = "5 dB"; }), "shutter");
}

}  // namespace
}  // namespace azimuth::iidc
