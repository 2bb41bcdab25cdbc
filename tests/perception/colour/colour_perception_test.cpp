// Painted landmarks in every format, and unusable images.

#include "slam/perception/colour/colour_perception.hpp"

#include <gmock/gmock.h>

#include "tests/perception/colour/colour_images.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using test::Canvas;
using test::Frame;
using test::Wedge;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kWithin_rad = 2.5e-3;  // less than half a pixel at a radius of 150 px
constexpr int kWidth_px = 640, kHeight_px = 480;
constexpr double kCentreU_px = 322.3, kCentreV_px = 238.6, kOffset_rad = -kPi / 2;

CameraRig rig() {
  CameraRig rig{.model = RadialRig{}, .image = {}};
  rig.image.width_px = kWidth_px;
  rig.image.height_px = kHeight_px;
  rig.image.centre_px = {kCentreU_px, kCentreV_px};
  rig.image.azimuth_direction = -1;
  rig.image.azimuth_offset_rad = kOffset_rad;
  rig.image.mask_inner_px = 40.0;
  rig.image.mask_outer_px = 235.0;
  return rig;
}

Wedge wedge_at(double azimuth_rad) {
  return {kCentreU_px, kCentreV_px, wrap(kOffset_rad - azimuth_rad), 0.06, 120.0, 180.0};
}

/// One cylinder of each class, the red one first.
const Canvas& four_cylinders() {
  static const Canvas canvas = [] {
    Canvas painting(kWidth_px, kHeight_px);
    const std::array colours{test::kRed, test::kYellow, test::kGreen, test::kBlue};
    for (std::size_t i = 0; i < 4; ++i) paint(painting, wedge_at(0.3 + 1.4 * static_cast<double>(i)), colours[i]);
    return painting;
  }();
  return canvas;
}

BearingSet observed(ColourPerception& perception, const ImageView& image) {
  BearingSet set;
  set.bearings.resize(3);  // leftovers of the previous image, which must disappear
  set.descriptors.resize(3);
  set.trouble = ImageTrouble::dark;
  perception.observe(image, set);
  return set;
}

BearingSet observed(const ImageView& image, const CameraRig& camera = rig(), const ColourSettings& settings = {}) {
  ColourPerception perception(camera, settings);
  return observed(perception, image);
}

void expect_four(const BearingSet& set, double within_rad) {
  EXPECT_EQ(set.trouble, ImageTrouble::none);
  EXPECT_THAT(set.descriptors, IsEmpty());
  ASSERT_THAT(set.bearings, SizeIs(4));
  for (const Bearing& bearing : set.bearings) {
    ASSERT_GE(bearing.kind, 0);
    EXPECT_NEAR(wrap(bearing.azimuth_rad - (0.3 + 1.4 * bearing.kind)), 0.0, within_rad) << bearing.kind;
    EXPECT_TRUE(std::isnan(bearing.elevation_rad));
    EXPECT_EQ(bearing.identity, kUnknownIdentity);
    EXPECT_GT(bearing.sigma_rad, 1e-4);
    EXPECT_LT(bearing.sigma_rad, 0.02);
    EXPECT_NEAR(bearing.radius_px, 150.0, 10.0);
  }
}

class EveryColourFormat : public testing::TestWithParam<PixelFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, EveryColourFormat, testing::ValuesIn(test::kColourFormats), test::PrintedName());

TEST_P(EveryColourFormat, ShowsEachCylinderInItsKindAndDirection) {
  for (const int padding : {0, 3, 64})
    expect_four(observed(test::taken(four_cylinders(), GetParam(), padding).view()), kWithin_rad);
}

TEST_P(EveryColourFormat, HalfTheLightChangesNothing) {
  Canvas canvas = four_cylinders();
  for (Rgb& pixel : canvas.pixels) pixel = test::mixed({}, pixel, 0.5);
  expect_four(observed(test::taken(canvas, GetParam()).view()), kWithin_rad);
}

TEST_P(EveryColourFormat, NoiseOfASensorDoesNoHarm) {
  std::mt19937 random(9);
  Canvas canvas = four_cylinders();
  add_noise(canvas, 6.0, random);
  expect_four(observed(test::taken(canvas, GetParam()).view()), 4e-3);
}

TEST_P(EveryColourFormat, PlainImagesShowNothingAndAreNoTrouble) {
  for (const Rgb colour : {Rgb{0, 0, 0}, Rgb{255, 255, 255}, test::kGrey, test::kRed}) {
    const BearingSet set = observed(test::taken(Canvas(kWidth_px, kHeight_px, colour), GetParam()).view());
    EXPECT_THAT(set.bearings, IsEmpty());
    EXPECT_EQ(set.trouble, ImageTrouble::none);
  }
}

TEST_P(EveryColourFormat, RandomBytesOfAnySizeAreSafe) {
  std::mt19937 random(10);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  CameraRig any_size = rig();
  any_size.image.width_px.reset();
  any_size.image.height_px.reset();
  any_size.image.centre_px.reset();
  any_size.image.mask_inner_px = 1.0;
  ColourSettings greedy;
  greedy.area_min_px2 = 0.0;
  greedy.compactness_min = greedy.elongation_min = greedy.fill_min = greedy.straightness_min = 0.0;
  greedy.compactness_max = greedy.elongation_max = greedy.fill_max = 1e9;
  ColourPerception perception(any_size, greedy);
  for (int i = 0; i < 150; ++i) {
    const int width_px = i % 10 == 0 ? 2 : 2 * draw(1, 70);
    Frame frame = test::frame_with_stride(GetParam(), width_px, draw(1, 80), draw(0, 9));
    // Probability (per cent) to repeat the previous value: from noise to long runs.
    const int like_before = draw(0, 100);
    int value = 0;
    for (std::byte& byte : frame.bytes) {
      if (draw(0, 99) >= like_before) value = draw(0, 255);
      byte = static_cast<std::byte>(value);
    }
    for (const Bearing& bearing : observed(perception, frame.view()).bearings) {
      ASSERT_TRUE(bearing.azimuth_rad >= -kPi && bearing.azimuth_rad < kPi);
      ASSERT_TRUE(bearing.sigma_rad > 0.0);
      ASSERT_TRUE(bearing.kind >= 0 && bearing.kind < 4);
    }
  }
}

TEST_P(EveryColourFormat, AllocatesNothingFromImageToImage) {
  const Frame frame = test::taken(four_cylinders(), GetParam());
  ColourPerception perception(rig(), {});
  BearingSet set;
  set.bearings.reserve(kTypicalBearings);
  perception.observe(frame.view(), set);
  const std::size_t before = allocations();
  for (int i = 0; i < 3; ++i) perception.observe(frame.view(), set);
  EXPECT_EQ(allocations(), before);
  EXPECT_THAT(set.bearings, SizeIs(4));
}

TEST(ColourPerception, SaysThatImagesAreUnreadable) {
  ColourPerception perception(rig(), {});
  const Frame good = test::taken(four_cylinders(), PixelFormat::rgb8);
  ImageView cut = good.view();
  cut.bytes = cut.bytes.first(cut.bytes.size() - 1);
  const Frame small = test::taken(Canvas(320, 240), PixelFormat::rgb8);
  const Frame grey = test::frame_with_stride(PixelFormat::gray8, kWidth_px, kHeight_px, 0);
  const std::vector<std::byte> jpeg(1000);
  const ImageView mjpeg{{PixelFormat::mjpeg, kWidth_px, kHeight_px, 0}, jpeg};
  for (const ImageView& bad : {ImageView{}, cut, small.view(), grey.view(), mjpeg}) {
    const BearingSet set = observed(perception, bad);
    EXPECT_EQ(set.trouble, ImageTrouble::unreadable) << name(bad.format.pixels);
    EXPECT_THAT(set.bearings, IsEmpty());
    expect_four(observed(perception, good.view()), kWithin_rad);  // the next good image must be processed normally
  }
}

TEST(ColourPerception, GoesFromFormatToFormat) {
  ColourPerception perception(rig(), {});
  for (const PixelFormat pixels : {PixelFormat::rgb8, PixelFormat::bayer_grbg8, PixelFormat::yuyv, PixelFormat::rgb8})
    expect_four(observed(perception, test::taken(four_cylinders(), pixels).view()), kWithin_rad);
}

TEST(ColourPerception, KnowsConfettiFromTheWorld) {
  std::mt19937 random(11);
  Frame noise = test::frame_with_stride(PixelFormat::rgb8, kWidth_px, kHeight_px, 0);
  for (std::byte& byte : noise.bytes) byte = static_cast<std::byte>(random());
  EXPECT_EQ(observed(noise.view()).trouble, ImageTrouble::unreadable);
}

TEST(ColourPerception, TakesTheRigsAxesAndLeavesItsYawToOthers) {
  CameraRig turned = rig();
  turned.image.azimuth_direction = 1;
  turned.image.azimuth_offset_rad = 2.0;
  turned.yaw_offset_rad = 0.7;
  const BearingSet set = observed(test::taken(four_cylinders(), PixelFormat::rgb8).view(), turned);
  ASSERT_THAT(set.bearings, SizeIs(4));
  for (const Bearing& bearing : set.bearings)
    EXPECT_NEAR(wrap(bearing.azimuth_rad - (2.0 + kOffset_rad - (0.3 + 1.4 * bearing.kind))), 0.0, kWithin_rad);
}

TEST(ColourPerception, KnowsPixelsThatAreNotSquare) {
  constexpr double kBeta = 0.8;
  CameraRig flat = rig();
  flat.image.beta = kBeta;
  flat.image.height_px = 384;
  const Canvas round = four_cylinders();
  Canvas squeezed(kWidth_px, 384);
  for (int v = 0; v < 384; ++v)
    for (int u = 0; u < kWidth_px; ++u) {
      const int above = static_cast<int>(v / kBeta);
      squeezed.at(u, v) = test::mixed(round.at(u, above), round.at(u, std::min(above + 1, 479)), v / kBeta - above);
    }
  expect_four(observed(test::taken(squeezed, PixelFormat::rgb8).view(), flat), 3e-3);
}

TEST(ColourPerception, PassesOverWhatIsHiddenOrReachesTheEdgeOfSight) {
  CameraRig with_strut = rig();  // a strut that hides one whole side of the red landmark
  const double red = wrap(kOffset_rad - 0.3);
  const auto at = [&](double off_rad, double radius_px) {
    return PixelPoint{kCentreU_px + radius_px * std::cos(red + off_rad),
                      kCentreV_px + radius_px * std::sin(red + off_rad)};
  };
  with_strut.image.mask_polygons_px = {{at(0.03, 40.0), at(0.03, 235.0), at(0.2, 235.0), at(0.2, 40.0)}};
  const BearingSet set = observed(test::taken(four_cylinders(), PixelFormat::rgb8).view(), with_strut);
  EXPECT_THAT(set.bearings, SizeIs(3));
  for (const Bearing& bearing : set.bearings) EXPECT_NE(bearing.kind, 0);

  CameraRig narrow = rig();  // a mask that hides the far ends; the sides still determine the direction
  narrow.image.mask_outer_px = 172.0;
  expect_four(observed(test::taken(four_cylinders(), PixelFormat::rgb8).view(), narrow), kWithin_rad);
}

// The visible parts of its sides identify the landmark in front; the one behind has no visible side of its own there.
TEST(ColourPerception, PassesOverWhatStandsBehind) {
  Canvas canvas(kWidth_px, kHeight_px);
  Wedge front = wedge_at(1.0), behind = wedge_at(1.07);
  behind.near_px = 130.0;
  behind.far_px = 165.0;
  behind.half_width_rad = 0.035;
  paint(canvas, behind, test::kRed);
  paint(canvas, front, test::kBlue);
  const BearingSet set = observed(test::taken(canvas, PixelFormat::rgb8).view());
  ASSERT_THAT(set.bearings, SizeIs(1));
  EXPECT_EQ(set.bearings[0].kind, 3);
  EXPECT_NEAR(set.bearings[0].azimuth_rad, 1.0, 2e-3);
}

TEST(ColourPerception, TwoOfOneColourSideBySideAreNone) {
  Canvas canvas(kWidth_px, kHeight_px);
  paint(canvas, wedge_at(1.0), test::kGreen);
  Wedge other = wedge_at(1.1);
  other.near_px = 135.0;
  other.far_px = 160.0;
  paint(canvas, other, test::kGreen);
  for (const Bearing& bearing : observed(test::taken(canvas, PixelFormat::rgb8).view()).bearings)
    EXPECT_NEAR(bearing.azimuth_rad, 1.0, 3 * bearing.sigma_rad) << "if anything, the one whose sides are seen";
}

TEST(ColourPerception, EveryBoundOfShapeCounts) {
  const Frame frame = test::taken(four_cylinders(), PixelFormat::rgb8);
  const auto count = [&](auto&& change) {
    ColourSettings settings;
    change(settings);
    return observed(frame.view(), rig(), settings).bearings.size();
  };
  EXPECT_EQ(count([](ColourSettings& s) { s.area_min_px2 = 2000; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.area_max_px2 = 500; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.compactness_min = 0.7; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.compactness_max = 0.3; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.elongation_min = 5; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.elongation_max = 2; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.fill_min = 1.2; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.fill_max = 0.7; }), 0U);
  EXPECT_EQ(count([](ColourSettings& s) { s.classes.resize(2); }), 2U);
}

}  // namespace
}  // namespace azimuth
