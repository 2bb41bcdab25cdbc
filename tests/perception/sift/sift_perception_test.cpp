#include "slam/perception/sift/sift_perception.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/perception/sift/matches.hpp"
#include "tests/perception/sift/rigs.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using test::Image;

BearingSet observed(const Image& image, const CameraRig& rig = test::lab_mirror_rig(),
                    const SiftSettings& settings = {}) {
  BearingSet set;
  SiftPerception(rig, settings).observe(image.view(), set);
  return set;
}

TEST(SiftPerception, FillsOneOfEachForEveryFeature) {
  const BearingSet set = observed(test::mirror_image());
  EXPECT_GE(set.bearings.size(), 40U);
  EXPECT_EQ(set.descriptors.size(), set.bearings.size());
  EXPECT_EQ(set.neighbours.size(), set.bearings.size());
  EXPECT_EQ(set.trouble, ImageTrouble::none);
  for (const Bearing& bearing : set.bearings) {
    EXPECT_EQ(bearing.identity, kUnknownIdentity);
    EXPECT_EQ(bearing.kind, kAnyKind);
    EXPECT_GT(bearing.sigma_rad, 0.0005);
    EXPECT_LT(bearing.sigma_rad, 0.06);
    EXPECT_EQ(bearing.azimuth_rad, wrap(bearing.azimuth_rad));
    EXPECT_FALSE(std::isnan(bearing.elevation_rad));
  }
}

/// The number of features must not depend on the light, except in darkness. The paper uses an absolute contrast.
TEST(SiftPerception, FindsAsMuchInDimLight) {
  const Image room = test::mirror_image();
  SiftSettings absolute;
  absolute.contrast_light = 0.0;
  const std::size_t bright = observed(test::scaled(room, 0.6)).bearings.size();
  for (const double light : {0.4, 0.25, 0.15}) {
    const std::size_t found = observed(test::scaled(room, light)).bearings.size();
    const std::size_t found_before =
        observed(test::scaled(room, light), test::lab_mirror_rig(), absolute).bearings.size();
    std::printf("light %.2f: %zu features, with an absolute contrast %zu\n", light, found, found_before);
    EXPECT_GE(2 * found, bright) << light;
    EXPECT_LE(2 * found_before, found) << light;
  }
  EXPECT_EQ(observed(room).descriptors, observed(room, test::lab_mirror_rig(), absolute).descriptors) << "well lit";
}

TEST(SiftPerception, ContrastAsPrintedDoesNotFollowTheLight) {
  EXPECT_EQ(paper_sift_preset().contrast, 0.10);
  EXPECT_EQ(paper_sift_preset().contrast_light, 0.0);
}

/// Bearings of features must be the directions that the camera model gives for their pixels.
void expect_directions_of_the_model(const CameraRig& rig) {
  std::string problem;
  const CameraModel model = *camera_of(rig, problem);
  SiftPerception perception(rig, {});
  const test::SeenFeatures features = test::seen(perception, test::mirror_image().view());
  for (std::size_t i = 0; i < features.key_points.size(); ++i) {
    const KeyPoint& point = features.key_points[i];
    const auto expected = model.direction(perception.working_square().camera_pixel(point.x_px, point.y_px));
    ASSERT_TRUE(expected);
    EXPECT_NEAR(wrap(features.set.bearings[i].azimuth_rad - expected->azimuth_rad), 0.0, 1e-12);
    EXPECT_NEAR(features.set.bearings[i].elevation_rad, expected->elevation_rad, 1e-12);
    const Pixel from_centre = *model.upright().pixel(*expected) - axes_of(rig.image).centre_px;
    EXPECT_NEAR(features.set.bearings[i].radius_px, from_centre.norm(), 1e-9);
  }
}

TEST(SiftPerception, PutsDirectionsWhereTheModelHasThem) {
  CameraRig rig = test::lab_mirror_rig();
  expect_directions_of_the_model(rig);
  rig.roll_rad = 0.06;
  rig.pitch_rad = -0.1;
  expect_directions_of_the_model(rig);
}

/// The robot turns on the spot in the renderer: azimuths must change by the turn, with errors that agree with their
/// sigma.
TEST(SiftPerception, AzimuthsTurnWithTheRobot) {
  SiftPerception perception(test::lab_mirror_rig(), {});
  const test::SeenFeatures before = test::seen(perception, test::mirror_image().view());
  for (const double turn_rad : {0.2, -1.3, 3.0}) {
    const Image turned = test::rendered(test::lab_scene(), test::mirror_camera(), {0.0, 0.0, turn_rad});
    const test::SeenFeatures after = test::seen(perception, turned.view());
    std::vector<double> squares;
    const auto same = [&](std::size_t i, std::size_t j) {
      const Bearing &from = before.set.bearings[i], &to = after.set.bearings[j];
      const double off_rad = wrap(to.azimuth_rad - from.azimuth_rad + turn_rad);
      if (std::abs(off_rad) > 0.02) return false;
      squares.push_back(off_rad * off_rad / (from.sigma_rad * from.sigma_rad + to.sigma_rad * to.sigma_rad));
      return true;
    };
    const test::MatchCount count = test::count_matches(before, after, 0.8, same);
    EXPECT_GE(count.right_share(), 0.8) << turn_rad;
    ASSERT_FALSE(squares.empty());
    std::ranges::sort(squares);
    EXPECT_LT(squares[squares.size() * 95 / 100], 9.0) << turn_rad;
  }
}

TEST(SiftPerception, KnowsNoElevationWithoutAModel) {
  CameraRig rig = test::lab_mirror_rig();
  rig.model = RadialRig{};
  const BearingSet set = observed(test::mirror_image(), rig);
  ASSERT_FALSE(set.bearings.empty());
  for (const Bearing& bearing : set.bearings) EXPECT_TRUE(std::isnan(bearing.elevation_rad));
}

/// Pixels of the rim, of the robot and outside the mirror must not affect the features.
TEST(SiftPerception, HiddenPartsDoNotMatter) {
  const CameraRig rig = test::lab_mirror_rig();
  Random random(1, RandomPurpose::scene);
  Image noise = test::blank(PixelFormat::gray8, 1024, 768);
  for (std::byte& byte : noise.bytes) byte = static_cast<std::byte>(random.uniform(0.0, 255.9));
  const BearingSet clean = observed(test::mirror_image()),
                   noisy = observed(test::combined(test::mirror_image(), noise, rig.image));
  EXPECT_EQ(clean.descriptors, noisy.descriptors);
}

TEST(SiftPerception, ReadsEveryUncompressedFormat) {
  const BearingSet gray = observed(test::mirror_image());
  for (const PixelFormat pixels : test::kUncompressed) {
    const BearingSet set = observed(test::in_format(test::mirror_image(), pixels));
    EXPECT_GE(set.bearings.size(), 40U) << name(pixels);
    const bool blurred = pixels >= PixelFormat::bayer_rggb8;  // by the reconstruction of the mosaic
    if (!blurred) {
      EXPECT_EQ(set.descriptors, gray.descriptors) << name(pixels);
    }
  }
}

TEST(SiftPerception, SaysWhatItCannotRead) {
  SiftPerception perception(test::lab_mirror_rig(), {});
  BearingSet set;
  perception.observe(test::mirror_image().view(), set);
  const Image& image = test::mirror_image();
  perception.observe({image.format, std::span(image.bytes).first(1000)}, set);
  EXPECT_EQ(set.trouble, ImageTrouble::unreadable);
  EXPECT_TRUE(set.bearings.empty() && set.descriptors.empty() && set.neighbours.empty());
  perception.observe({}, set);
  EXPECT_EQ(set.trouble, ImageTrouble::unreadable);
  perception.observe(image.view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::none);

  CameraRig sized = test::lab_mirror_rig();
  sized.image.width_px = 1280;
  EXPECT_EQ(observed(image, sized).trouble, ImageTrouble::unreadable);
}

TEST(SiftPerception, OneGreyAndTinyImagesHaveNothing) {
  for (const int side_px : {1, 2, 3, 4, 8, 17, 64}) {
    const Image image = test::blank(PixelFormat::gray8, side_px, side_px);
    EXPECT_TRUE(observed(image).bearings.empty());
    EXPECT_TRUE(observed(image, CameraRig{}).bearings.empty());
  }
}

TEST(SiftPerception, AMaskThatHidesEverythingHasNothing) {
  CameraRig rig = test::lab_mirror_rig();
  rig.image.mask_polygons_px = {{{-10.0, -10.0}, {2000.0, -10.0}, {2000.0, 2000.0}, {-10.0, 2000.0}}};
  EXPECT_TRUE(observed(test::mirror_image(), rig).bearings.empty());
}

/// Random bytes, sizes and centres: no crash, no more features than requested, and the same result in a repetition.
TEST(SiftPerception, SurvivesAnything) {
  Random random(4, RandomPurpose::scene);
  for (int trial = 0; trial < 40; ++trial) {
    const PixelFormat pixels = test::kUncompressed[static_cast<std::size_t>(trial) % test::kUncompressed.size()];
    const int width_px = 2 * static_cast<int>(random.uniform(1.0, 90.0));
    Image image = test::blank(pixels, width_px, static_cast<int>(random.uniform(1.0, 150.0)));
    for (std::byte& byte : image.bytes) byte = static_cast<std::byte>(random.uniform(0.0, 255.9));
    CameraRig rig =
        test::ring_rig(random.uniform(-50.0, 200.0), random.uniform(-50.0, 200.0), 3.0, random.uniform(3.0, 300.0));
    rig.image.beta = random.uniform(0.5, 2.0);
    SiftSettings settings;
    settings.side_px = trial % 3 == 0 ? 0 : 60;
    settings.contrast = 0.001;
    const BearingSet once = observed(image, rig, settings), again = observed(image, rig, settings);
    EXPECT_LE(once.bearings.size(), static_cast<std::size_t>(settings.target_count));
    EXPECT_EQ(once.descriptors, again.descriptors);
    for (const Bearing& bearing : once.bearings) EXPECT_TRUE(std::isfinite(bearing.azimuth_rad));
  }
}

TEST(SiftPerception, AllocatesOnlyForTheFirstImages) {
  SiftPerception perception(test::lab_mirror_rig(), {});
  BearingSet set;
  for (int i = 0; i < 2; ++i) perception.observe(test::mirror_image().view(), set);
  const std::size_t before = allocations();
  for (int i = 0; i < 3; ++i) perception.observe(test::mirror_image().view(), set);
  EXPECT_EQ(allocations(), before);
}

TEST(SiftPerception, OpenCvServesAsAReference) {
  SiftSettings settings;
  settings.detector = SiftDetector::opencv;
  const BearingSet set = observed(test::mirror_image(), test::lab_mirror_rig(), settings);
  EXPECT_GE(set.bearings.size(), 40U);
  EXPECT_LE(set.bearings.size(), static_cast<std::size_t>(settings.target_count));
  EXPECT_EQ(set.descriptors.size(), set.bearings.size());
  EXPECT_EQ(set.neighbours.size(), set.bearings.size());
}

}  // namespace
}  // namespace azimuth
