#include "drivers/picture/picture.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

constexpr int kWidth_px = 200, kHeight_px = 160;
constexpr double kInner_px = 20.0, kOuter_px = 70.0;

CameraRig rig() {
  CameraRig rig;
  rig.model = RadialRig{};
  rig.image.width_px = kWidth_px;
  rig.image.height_px = kHeight_px;
  rig.image.centre_px = PixelPoint{100.0, 80.0};
  rig.image.azimuth_offset_rad = -kPi / 2.0;  // the robot's forward direction is up, left is left
  rig.image.mask_inner_px = kInner_px;
  rig.image.mask_outer_px = kOuter_px;
  return rig;
}

/// An image of one colour.
struct Plain {
  explicit Plain(PixelFormat pixels, std::uint8_t value = 40)
      : format(packed_format(pixels, kWidth_px, kHeight_px)), bytes(format.bytes(), std::byte{value}) {}
  ImageView view() const { return {format, bytes}; }
  FrameFormat format;
  std::vector<std::byte> bytes;
};

using Rgb = std::array<int, 3>;

/// Colour of the picture at a place of the image.
Rgb colour_at(const ImageView& picture, double u, double v) {
  const auto column = static_cast<std::size_t>(std::lround(u)) + Canvas::kMargin_px;
  const std::uint8_t* const pixel = picture.row(static_cast<int>(std::lround(v)) + Canvas::kMargin_px) + 3 * column;
  return {pixel[0], pixel[1], pixel[2]};
}

bool is_magenta(const Rgb& colour) { return colour[0] > 180 && colour[1] < 90 && colour[2] > 180; }
bool is_red(const Rgb& colour) { return colour[0] > 180 && colour[1] < 140 && colour[2] < 140; }
bool is_green(const Rgb& colour) { return colour[1] > 180 && colour[0] < 140 && colour[2] < 140; }

TEST(Picture, ShowsTheImageWithAMargin) {
  Picture picture(rig());
  const Plain image(PixelFormat::gray8, 77);
  const ImageView drawn = picture.draw(image.view(), {}, {});
  EXPECT_EQ(drawn.format,
            packed_format(PixelFormat::rgb8, kWidth_px + 2 * Canvas::kMargin_px, kHeight_px + 2 * Canvas::kMargin_px));
  ASSERT_TRUE(drawn.readable());
  EXPECT_EQ(colour_at(drawn, 5, 150), (Rgb{77, 77, 77}));
  EXPECT_EQ(colour_at(drawn, -40, 80), (Rgb{0, 0, 0}));
  EXPECT_NE(colour_at(drawn, 100 + kOuter_px, 80), (Rgb{77, 77, 77})) << "the rim's outline";
  EXPECT_NE(colour_at(drawn, 100, 80 + kInner_px), (Rgb{77, 77, 77}));
}

TEST(Picture, ABearingIsARadialLineInTheColourOfItsKind) {
  Picture picture(rig());
  const Plain image(PixelFormat::gray8);
  BearingSet seen;
  seen.bearings = {{.azimuth_rad = kPi / 2.0, .kind = 0}, {.azimuth_rad = kPi, .kind = 2}};  // to the left, behind
  const std::vector<ExpectedBearing> expected{{.landmark = 1, .kind = 0, .azimuth_rad = 1.5, .gate_rad = 0.2},
                                              {.landmark = 2, .kind = 2, .azimuth_rad = -3.1, .gate_rad = 0.2}};
  const ImageView drawn = picture.draw(image.view(), seen, expected);
  EXPECT_TRUE(is_red(colour_at(drawn, 100 - 45, 80)));
  EXPECT_TRUE(is_green(colour_at(drawn, 100, 80 + 45)));
  EXPECT_EQ(colour_at(drawn, 100 + 45, 80), (Rgb{40, 40, 40})) << "nothing on the right";
}

TEST(Picture, ABearingThatNothingExplainsStandsOut) {
  Picture picture(rig());
  const Plain image(PixelFormat::gray8);
  BearingSet seen;
  seen.bearings = {{.azimuth_rad = 0.0, .kind = 0}};
  const auto ahead = [&](const ExpectedBearing& expected) {
    return colour_at(picture.draw(image.view(), seen, std::span(&expected, 1)), 100, 80 - 45);
  };
  EXPECT_TRUE(is_red(ahead({.kind = 0, .azimuth_rad = 0.1, .gate_rad = 0.11})));
  EXPECT_TRUE(is_red(ahead({.kind = kAnyKind, .azimuth_rad = -0.1, .gate_rad = 0.11})));
  EXPECT_TRUE(is_magenta(ahead({.kind = 0, .azimuth_rad = 0.1, .gate_rad = 0.09}))) << "outside the gate";
  EXPECT_TRUE(is_magenta(ahead({.kind = 1, .azimuth_rad = 0.1, .gate_rad = 0.11}))) << "of another kind";
}

TEST(Picture, AGateIsAnArcOutsideTheRim) {
  Picture picture(rig());
  const Plain image(PixelFormat::gray8);
  const std::vector<ExpectedBearing> expected{{.kind = 2, .azimuth_rad = -kPi / 2.0, .gate_rad = 0.3}};
  const ImageView drawn = picture.draw(image.view(), {}, expected);
  const double radius_px = kOuter_px + 8.0;
  const auto on_the_arc = [&](double off_rad) {
    return colour_at(drawn, 100 + radius_px * std::cos(off_rad), 80 + radius_px * std::sin(off_rad));
  };
  EXPECT_TRUE(is_green(on_the_arc(0.0)));
  EXPECT_TRUE(is_green(on_the_arc(0.25)));
  EXPECT_TRUE(is_green(on_the_arc(-0.25)));
  EXPECT_FALSE(is_green(on_the_arc(0.4)));
}

TEST(Picture, AFeatureWithElevationIsACircleWhereItIsSeen) {
  CameraRig with_model = rig();
  with_model.model = ParabolicMirrorRig{.horizon_radius_px = 45.0};
  Picture picture(with_model);
  const Plain image(PixelFormat::gray8);
  BearingSet seen;
  seen.bearings = {{.azimuth_rad = kPi / 2.0, .elevation_rad = 0.0}};  // on the circle of the horizon
  const ImageView drawn = picture.draw(image.view(), seen, {});
  EXPECT_TRUE(is_magenta(colour_at(drawn, 100 - 45 - 4, 80)));
  EXPECT_EQ(colour_at(drawn, 100 - 45, 80), (Rgb{40, 40, 40})) << "its middle stays free";
}

CameraRig fisheye_rig() {
  CameraRig fisheye = rig();
  fisheye.model = EquidistantRig{.focal_length_px = 50.0};  // 0.02 rad per pixel
  fisheye.image.mask_inner_px.reset();
  fisheye.image.theta_max_rad = 1.4;
  return fisheye;
}

TEST(Picture, WhereAnElevationIsExpectedTheGateIsThereInTheImage) {
  Picture picture(fisheye_rig());
  const Plain image(PixelFormat::gray8);
  const std::vector<ExpectedBearing> expected{{.kind = 2,
                                               .azimuth_rad = kPi / 2.0,
                                               .gate_rad = 0.2,
                                               .elevation_rad = kPi / 2.0 - 0.8,  // 40 px to the left
                                               .gate_elevation_rad = 0.3}};
  const ImageView drawn = picture.draw(image.view(), {}, expected);
  EXPECT_TRUE(is_green(colour_at(drawn, 60, 80))) << "the cross";
  EXPECT_TRUE(is_green(colour_at(drawn, 60 - 15, 80)));
  EXPECT_TRUE(is_green(colour_at(drawn, 60 + 15, 80)));
  EXPECT_TRUE(is_green(colour_at(drawn, 100 - 40 * std::cos(0.2), 80 - 40 * std::sin(0.2))));
  EXPECT_FALSE(is_green(colour_at(drawn, 100 - kOuter_px - 8.0, 80))) << "nothing at the rim";
}

TEST(Picture, ALampAtTheRightAzimuthAndTheWrongElevationStandsOut) {
  Picture picture(fisheye_rig());
  const Plain image(PixelFormat::gray8);
  const auto circle = [&](double elevation_rad) {
    BearingSet seen;
    seen.bearings = {{.azimuth_rad = 0.0, .elevation_rad = kPi / 2.0 - 0.4, .kind = 0}};  // 20 px upwards
    const ExpectedBearing expected{
        .kind = 0, .azimuth_rad = 0.0, .gate_rad = 0.5, .elevation_rad = elevation_rad, .gate_elevation_rad = 0.1};
    return colour_at(picture.draw(image.view(), seen, std::span(&expected, 1)), 100 + 4, 60);
  };
  EXPECT_TRUE(is_red(circle(kPi / 2.0 - 0.31)));
  EXPECT_TRUE(is_magenta(circle(kPi / 2.0 - 0.9)));
}

TEST(Picture, WithoutAnImageItIsBlackAndSaysWhy) {
  Picture picture(rig());
  BearingSet seen;
  const ImageView silent = picture.draw({}, seen, {});
  const std::vector<std::byte> before(silent.bytes.begin(), silent.bytes.end());
  seen.trouble = ImageTrouble::unreadable;
  const ImageView drawn = picture.draw({}, seen, {});
  EXPECT_EQ(drawn.format.width_px, kWidth_px + 2 * Canvas::kMargin_px);
  EXPECT_FALSE(std::ranges::equal(drawn.bytes, before));
}

TEST(Picture, SameInputSameBytes) {
  const Plain image(PixelFormat::rgb8);
  BearingSet seen;
  seen.bearings = {{.azimuth_rad = 0.3, .identity = 12, .kind = 3}};
  const std::vector<ExpectedBearing> expected{{.landmark = 5, .azimuth_rad = 0.31, .gate_rad = 0.1}};
  Picture one(rig()), other(rig());
  other.draw(Plain(PixelFormat::gray8, 200).view(), {}, {});  // must leave no trace
  EXPECT_TRUE(
      std::ranges::equal(one.draw(image.view(), seen, expected).bytes, other.draw(image.view(), seen, expected).bytes));
}

/// The bytes of a picture with one expected landmark.
std::vector<std::byte> with_expected(std::int64_t landmark, std::optional<std::span<const std::int64_t>> in_map) {
  Picture picture(rig());
  const std::vector<ExpectedBearing> expected{{.landmark = landmark, .azimuth_rad = 0.31, .gate_rad = 0.1}};
  const ImageView drawn = picture.draw(Plain(PixelFormat::gray8).view(), {}, expected, in_map);
  return {drawn.bytes.begin(), drawn.bytes.end()};
}

TEST(Picture, LandmarksAreCountedInTheOrderOfTheirIds) {
  const std::vector<std::int64_t> in_map{31, 113};
  EXPECT_EQ(with_expected(113, in_map), with_expected(2, std::nullopt));
  EXPECT_NE(with_expected(113, in_map), with_expected(113, std::nullopt));
  const std::vector<std::int64_t> others{31}, none;
  EXPECT_EQ(with_expected(113, others), with_expected(7, none)) << "those that are not in the map have no name";
  EXPECT_NE(with_expected(113, others), with_expected(113, in_map));
}

TEST(Picture, TimesAreForPeople) {
  const auto at = [](std::int64_t us) {
    Picture picture(rig());
    BearingSet seen;
    seen.stamp = Stamp{std::chrono::microseconds(us)};
    const ImageView drawn = picture.draw(Plain(PixelFormat::gray8).view(), seen, {});
    return std::vector<std::byte>(drawn.bytes.begin(), drawn.bytes.end());
  };
  EXPECT_EQ(at(80'400'000), at(80'401'234)) << "no millionths of a second";
  EXPECT_NE(at(80'400'000), at(80'500'000));
  EXPECT_EQ(at(1'789'000'000'400'000), at(1'789'000'000'401'234));
  EXPECT_NE(at(1'789'000'000'400'000), at(1'789'000'001'400'000));
}

class PictureFormats : public ::testing::TestWithParam<int> {};

/// Red in each format must appear red.
TEST_P(PictureFormats, ShowsRedAsRed) {
  const auto pixels = static_cast<PixelFormat>(GetParam());
  Plain image(pixels, 0);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      std::byte* const pixel = image.bytes.data() + v * image.format.stride_bytes + u * bytes_per_pixel(pixels);
      const bool odd_u = u % 2 == 1, odd_v = v % 2 == 1;
      const auto red = [&](bool here) { pixel[0] = here ? std::byte{230} : std::byte{0}; };
      switch (pixels) {
        case PixelFormat::yuyv:
          pixel[0] = std::byte{80}, pixel[1] = odd_u ? std::byte{240} : std::byte{90};
          break;
        case PixelFormat::nv12:
          pixel[0] = std::byte{80};
          image.bytes[static_cast<std::size_t>((kHeight_px + v / 2) * kWidth_px + u)] =
              odd_u ? std::byte{240} : std::byte{90};
          break;
        case PixelFormat::uyvy:
          pixel[1] = std::byte{80}, pixel[0] = odd_u ? std::byte{240} : std::byte{90};
          break;
        case PixelFormat::bgr8:
          pixel[2] = std::byte{230};
          break;
        case PixelFormat::rgb8:
          red(true);
          break;
        case PixelFormat::bayer_rggb8:
          red(!odd_u && !odd_v);
          break;
        case PixelFormat::bayer_grbg8:
          red(odd_u && !odd_v);
          break;
        case PixelFormat::bayer_gbrg8:
          red(!odd_u && odd_v);
          break;
        default:
          red(odd_u && odd_v);
      }
    }
  }
  Picture picture(rig());
  EXPECT_TRUE(is_red(colour_at(picture.draw(image.view(), {}, {}), 6, 150)));
}

// All formats except gray8, which has no colours, and mjpeg.
INSTANTIATE_TEST_SUITE_P(All, PictureFormats, ::testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 10), test::PrintedName());

TEST(Picture, AnyBytesAndAnyValuesAreSafe) {
  std::minstd_rand random(1);
  const auto number = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  for (int round = 0; round < 300; ++round) {
    FrameFormat format = packed_format(static_cast<PixelFormat>(number(kPixelFormats)), 1 + number(40), 1 + number(40));
    format.stride_bytes += number(9);
    std::vector<std::byte> bytes(static_cast<std::size_t>(number(8000)));
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    BearingSet seen;
    const double values[] = {0.0, 1e300, -1e300, std::nan(""), 3.0, INFINITY};
    for (const double value : values)
      seen.bearings.push_back({.azimuth_rad = value, .elevation_rad = values[number(6)], .kind = number(20) - 2});
    const std::vector<ExpectedBearing> expected{{.azimuth_rad = values[number(6)],
                                                 .gate_rad = values[number(6)],
                                                 .elevation_rad = values[number(6)],
                                                 .gate_elevation_rad = values[number(6)]}};
    CameraRig any = round % 5 < 2 ? fisheye_rig() : rig();
    if (round % 2 == 0) any.image.mask_outer_px.reset();
    if (round % 3 == 0) any.image.mask_polygons_px = {{{-1e9, 4.0}, {5.0, 1e9}, {3.0, 3.0}}};
    Picture picture(any);
    EXPECT_TRUE(picture.draw({format, bytes}, seen, expected).readable());
  }
}

}  // namespace
}  // namespace azimuth
