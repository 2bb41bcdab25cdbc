// Images composed of two instants, and images that are cut short and filled up: most must be recognised, whole images
// never.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <jpeglib.h>  // needs the first two
#include <random>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/png.hpp"
#include "sim/renderer/standard_cameras.hpp"
#include "slam/perception/image/image_watch.hpp"
#include "tests/perception/image/camera_images.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/support/data.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using test::Image;

/// `upper` above `row`, `lower` from there on.
Image torn(const Image& upper, const Image& lower, int row) {
  Image image = upper;
  const auto first = static_cast<std::ptrdiff_t>(row) * upper.format.stride_bytes;
  std::copy(lower.bytes.begin() + first, lower.bytes.end(), image.bytes.begin() + first);
  return image;
}

/// The images of a robot that moves by `step` from image to image.
std::vector<Image> rendered_drive(const RenderScene& scene, RenderCamera camera, int images, const Pose2& step,
                                  double noise, PixelFormat pixels = PixelFormat::gray8) {
  camera.sensor.noise = noise;
  Renderer renderer(scene, camera);
  std::vector<Image> drive;
  Pose2 T_world_body{-1.0, 0.5, 0.2};
  for (int i = 0; i < images; ++i, T_world_body = T_world_body * step)
    drive.push_back({packed_format(pixels, camera.width_px, camera.height_px),
                     test::frame_of(renderer, camera, T_world_body, pixels)});
  return drive;
}

int found_torn(const std::vector<Image>& images, const ImageRig& rig) {
  ImageWatch watch(rig);
  return static_cast<int>(std::ranges::count_if(
      images, [&](const Image& image) { return watch.judge(image.view()) == ImageTrouble::torn; }));
}

/// Counts of torn images that are recognised. Each is torn at a random row between two consecutive images.
struct Found {
  int images = 0, by_itself = 0, by_its_history = 0;
  void print(const std::string& what) const {
    fmt::print("{:<44} {:>3} torn: {:>3} seen in the image alone, {:>3} where the older one came before\n", what,
               images, by_itself, by_its_history);
  }
};

bool is_torn_after(const ImageRig& rig, std::initializer_list<const Image*> before, const Image& image) {
  ImageWatch watch(rig);
  for (const Image* earlier : before) watch.judge(earlier->view());
  return watch.judge(image.view()) == ImageTrouble::torn;
}

Found tear_all(const std::vector<Image>& images, const ImageRig& rig) {
  std::minstd_rand random(5);
  const int centre = static_cast<int>((*rig.centre_px)[1]), reach = static_cast<int>(0.9 * *rig.mask_outer_px);
  std::uniform_int_distribution<int> row(std::max(4, centre - reach),
                                         std::min(images.front().format.height_px - 4, centre + reach));
  Found found;
  for (std::size_t k = 1, step = 1 + images.size() / 100; k + 1 < images.size(); k += step) {
    const Image image = torn(images[k + 1], images[k], row(random));
    ++found.images;
    found.by_itself += is_torn_after(rig, {}, image) ? 1 : 0;
    found.by_its_history += is_torn_after(rig, {&images[k - 1], &images[k]}, image) ? 1 : 0;
  }
  return found;
}

const ImageRig kTornMirrorRig = standard_camera("mirror")->image;
const ImageRig kFisheyeRig = standard_camera("fisheye")->image;
const RenderScene& hall_scene() {
  static const RenderScene scene = lamp_scene(hall(1, 1), 6.5);
  return scene;
}

TEST(TornImages, AreRecognisedTheMoreTheRobotMoved) {
  struct Case {
    Pose2 step;
    int least_by_itself;
  };
  for (const Case& each : {Case{{0.02, 0.0, 0.0}, 0}, Case{{0.1, 0.0, 0.0}, 0}, Case{{0.3, 0.0, 0.0}, 4},
                           Case{{0.02, 0.0, 0.02}, 0}, Case{{0.05, 0.0, 0.1}, 3}}) {
    const std::vector<Image> drive = rendered_drive(test::lab_scene(), test::mirror_camera(), 14, each.step, 1.5);
    const Found found = tear_all(drive, kTornMirrorRig);
    found.print(fmt::format("lab, {:.2f} m and {:.2f} rad an image", each.step.x_m, each.step.heading_rad));
    EXPECT_EQ(found.by_its_history, found.images);
    EXPECT_GE(found.by_itself, each.least_by_itself);
    EXPECT_EQ(found_torn(drive, kTornMirrorRig), 0);
  }
}

TEST(TornImages, OfLampsShowByTheNoiseBetweenThem) {
  const std::vector<Image> drive = rendered_drive(hall_scene(), test::fisheye_camera(), 14, {0.1, 0.0, 0.02}, 1.5);
  const Found found = tear_all(drive, kFisheyeRig);
  found.print("hall, 0.10 m and 0.02 rad an image");
  EXPECT_EQ(found.by_its_history, found.images);
  EXPECT_EQ(found_torn(drive, kFisheyeRig), 0);
}

TEST(TornImages, ARobotThatTurnsFastOrStandsHasNone) {
  for (const double noise : {0.0, 3.0})
    for (const Pose2& step : {Pose2{0.3, 0.0, 0.3}, Pose2{0.0, 0.0, 0.0}}) {
      EXPECT_EQ(found_torn(rendered_drive(test::lab_scene(), test::mirror_camera(), 10, step, noise), kTornMirrorRig),
                0);
      EXPECT_EQ(found_torn(rendered_drive(hall_scene(), test::fisheye_camera(), 10, step, noise), kFisheyeRig), 0);
    }
}

class TornFormat : public testing::TestWithParam<PixelFormat> {};
INSTANTIATE_TEST_SUITE_P(Each, TornFormat, testing::ValuesIn(test::kUncompressed), test::PrintedName());

TEST_P(TornFormat, IsRecognisedByOneImage) {
  static const std::vector<Image> drive =
      rendered_drive(test::lab_scene(), test::mirror_camera(), 2, {0.3, 0.0, 0.2}, 1.5);
  const Image upper = test::in_format(drive[0], GetParam()), lower = test::in_format(drive[1], GetParam());
  EXPECT_EQ(found_torn({upper, lower}, kTornMirrorRig), 0);
  EXPECT_EQ(found_torn({torn(upper, lower, 300)}, kTornMirrorRig), 1);
}

/// A whole row brighter than the one above (a beam, or a lamp switched on during the readout) must not be taken for a
/// tear.
TEST(TornImages, AnEdgeAlongARowIsNoTear) {
  for (const int row : {200, 384, 500}) {
    Image image = rendered_drive(test::lab_scene(), test::mirror_camera(), 1, {}, 1.5).front();
    for (auto byte = image.bytes.begin() + row * 1024; byte != image.bytes.end(); ++byte)
      *byte = static_cast<std::byte>(std::min(255, std::to_integer<int>(*byte) + 40));
    EXPECT_EQ(found_torn({image}, kTornMirrorRig), 0) << row;
  }
}

std::vector<std::byte> jpeg_of(const Image& image) {
  JpegEncoder encoder;
  const auto bytes = encoder.encode(image.view(), 85);
  return {bytes.begin(), bytes.end()};
}

/// Decodes like most programs, which fill in missing data.
Image lenient(const std::vector<std::byte>& jpeg, int width_px, int height_px) {
  Image image = test::blank(PixelFormat::gray8, width_px, height_px);
  jpeg_decompress_struct decompress{};
  jpeg_error_mgr errors{};
  decompress.err = jpeg_std_error(&errors);
  errors.emit_message = [](j_common_ptr, int) {};
  jpeg_create_decompress(&decompress);
  jpeg_mem_src(&decompress, reinterpret_cast<const unsigned char*>(jpeg.data()), jpeg.size());
  jpeg_read_header(&decompress, TRUE);
  jpeg_start_decompress(&decompress);
  while (decompress.output_scanline < decompress.output_height) {
    auto* row = reinterpret_cast<unsigned char*>(image.bytes.data()) + decompress.output_scanline * as_size(width_px);
    jpeg_read_scanlines(&decompress, &row, 1);
  }
  jpeg_destroy_decompress(&decompress);
  return image;
}

struct Padding {
  const char* name;
  std::vector<std::byte> (*pad)(const std::vector<std::byte>& whole, std::size_t length);
};
std::vector<std::byte> cut(const std::vector<std::byte>& whole, std::size_t length) {
  return {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)};
}
const Padding kPaddings[] = {{"nothing", cut},
                             {"an end marker",
                              [](const std::vector<std::byte>& whole, std::size_t length) {
                                std::vector<std::byte> jpeg = cut(whole, length);
                                jpeg.insert(jpeg.end(), {std::byte{0xFF}, std::byte{0xD9}});
                                return jpeg;
                              }},
                             {"zeros",
                              [](const std::vector<std::byte>& whole, std::size_t length) {
                                std::vector<std::byte> jpeg = cut(whole, length);
                                jpeg.resize(whole.size() + 4096);
                                return jpeg;
                              }},
                             {"ones", [](const std::vector<std::byte>& whole, std::size_t length) {
                                std::vector<std::byte> jpeg = cut(whole, length);
                                jpeg.resize(whole.size() + 4096, std::byte{0xFF});
                                return jpeg;
                              }}};

TEST(TornImages, CutAndFilledUpIsRefusedByOurDecoderAndRecognisedAfterOthers) {
  const Image room = rendered_drive(test::lab_scene(), test::mirror_camera(), 1, {}, 1.5).front();
  const std::vector<std::byte> whole = jpeg_of(room);
  for (const Padding& padding : kPaddings) {
    int refused = 0, recognised = 0, cuts = 0;
    for (double share = 0.25; share < 0.85; share += 0.05) {
      const std::vector<std::byte> jpeg =
          padding.pad(whole, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
      JpegDecoder decoder;
      ++cuts;
      refused += decoder.decode(jpeg, PixelFormat::gray8).readable() ? 0 : 1;
      recognised += found_torn({lenient(jpeg, 1024, 768)}, kTornMirrorRig);
    }
    fmt::print("a JPEG cut and filled up with {:<14}: {} cuts, {} refused, {} recognised after a lenient decoder\n",
               padding.name, cuts, refused, recognised);
    EXPECT_EQ(refused, cuts) << padding.name;
    EXPECT_EQ(recognised, cuts) << padding.name;
  }
  EXPECT_EQ(found_torn({lenient(whole, 1024, 768)}, kTornMirrorRig), 0);
}

TEST(TornImages, LastRowRepeatedOrBlackIsRecognised) {
  const Image room = rendered_drive(test::lab_scene(), test::mirror_camera(), 1, {}, 1.5).front();
  for (int row = 100; row <= 650; row += 50) {
    Image repeated = room, black = room;
    const auto from = room.bytes.begin() + (row - 1) * 1024;
    for (int v = row; v < 768; ++v) std::copy_n(from, 1024, repeated.bytes.begin() + v * 1024);
    std::fill(black.bytes.begin() + row * 1024, black.bytes.end(), std::byte{0});
    EXPECT_EQ(found_torn({repeated}, kTornMirrorRig), 1) << row;
    EXPECT_EQ(found_torn({black}, kTornMirrorRig), 1) << row;
  }
}

struct TornCamera {
  test::CameraImages images;
  int least_by_itself, least_by_history;  // per cent
};

std::ostream& operator<<(std::ostream& out, const TornCamera& camera) { return out << camera.images; }

/// All files that are readable images.
std::vector<Image> real_images(const test::CameraImages& camera) {
  std::vector<Image> images;
  for (const auto& file : camera.files()) {
    Image image = test::read_image(file);
    if (image.view().readable()) images.push_back(std::move(image));
  }
  return images;
}

class TornRealImages : public testing::TestWithParam<TornCamera> {};
INSTANTIATE_TEST_SUITE_P(Each, TornRealImages,
                         testing::Values(TornCamera{{"mirror-images", "Kaidan", {326, 247}, 55, 222}, 50, 100},
                                         TornCamera{{"mirror-images", "Mini", {364, 224}, 0, 258}, 50, 100},
                                         TornCamera{{"mirror-calibration", "imgMei", {642, 521}, 55, 353}, 0, 100},
                                         TornCamera{{"ceiling-tubes", "", {320, 240}, 0, 330}, 0, 0},
                                         TornCamera{{"office-a/frames", "", {512, 384}, 60, 376}, 40, 99},
                                         TornCamera{{"hall-a/frames", "", {512, 384}, 0, 376}, 0, 99}),
                         test::PrintedName());

TEST_P(TornRealImages, AreRecognisedAndWholeOnesAreNot) {
  const TornCamera& camera = GetParam();
  AZIMUTH_REQUIRE_DATA(camera.images.folder);
  const ImageRig rig = camera.images.rig();
  const std::vector<Image> images = real_images(camera.images);
  EXPECT_EQ(found_torn(images, rig), 0) << "of " << images.size();
  const Found found = tear_all(images, rig);
  found.print(fmt::format("{} {}", camera.images.folder, camera.images.name_begins));
  EXPECT_GE(100 * found.by_itself, camera.least_by_itself * found.images);
  EXPECT_GE(100 * found.by_its_history, camera.least_by_history * found.images);
}

}  // namespace
}  // namespace azimuth
