// Three real mirror cameras and a ray-traced one. The circles were measured by hand in images unrolled about a trial
// centre and enlarged six times: the rim is straight when the centre is right.

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "drivers/camera/jpeg.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

struct RealMirror {
  const char *name, *folder, *files_begin;
  Pixel centre_px;
  double radius_px;
  std::size_t every = 1;       ///< uses every n-th file
  bool in_each_image = false;  ///< a single image suffices
};
std::ostream& operator<<(std::ostream& out, const RealMirror& each) { return out << each.name; }

std::vector<std::filesystem::path> files_of(const RealMirror& mirror) {
  std::vector<std::filesystem::path> all, files;
  for (const auto& entry : std::filesystem::directory_iterator(test::data_folder() / mirror.folder)) {
    if (entry.path().filename().string().starts_with(mirror.files_begin)) all.push_back(entry.path());
  }
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); i += mirror.every) files.push_back(all[i]);
  return files;
}

void add_jpeg(const std::filesystem::path& file, MirrorFinder& finder) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  JpegDecoder decoder;
  ASSERT_TRUE(finder.add(decoder.decode(std::as_bytes(std::span(bytes)), PixelFormat::gray8))) << file;
}

void expect_near(const std::optional<MirrorCircle>& found, const RealMirror& mirror) {
  ASSERT_TRUE(found);
  EXPECT_LT((found->rim.centre_px - mirror.centre_px).norm(), 3.0) << found->rim.centre_px.transpose();
  EXPECT_NEAR(found->rim.radius_px, mirror.radius_px, 3.0);
}

class RealMirrors : public testing::TestWithParam<RealMirror> {};
INSTANTIATE_TEST_SUITE_P(
    Each, RealMirrors,
    testing::Values(RealMirror{"kaidan", "mirror-images", "Kaidan", {325.5, 247.0}, 223.5, 1, true},
                    // A difficult mirror: grey on grey, a dusty rim, a third of it outside the image. Only several
                    // images together suffice.
                    RealMirror{"mini", "mirror-images", "Mini", {364.5, 224.0}, 257.5},
                    RealMirror{"paracatadioptric", "mirror-calibration", "imgMei", {642.3, 521.0}, 354.5, 1, true},
                    RealMirror{"office", "office-a/frames", "0000", {512.0, 384.0}, 376.0, 20, true}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(RealMirrors, AreFoundInTheSequence) {
  const RealMirror& mirror = GetParam();
  AZIMUTH_REQUIRE_DATA(mirror.folder);
  MirrorFinder finder;
  for (const std::filesystem::path& file : files_of(mirror)) add_jpeg(file, finder);
  ASSERT_GT(finder.images(), 2);
  expect_near(finder.find(), mirror);
}

TEST_P(RealMirrors, AreFoundInOneImage) {
  const RealMirror& mirror = GetParam();
  AZIMUTH_REQUIRE_DATA(mirror.folder);
  if (!mirror.in_each_image) GTEST_SKIP() << "not to be seen in one image";
  for (const std::filesystem::path& file : files_of(mirror)) {
    SCOPED_TRACE(file);
    MirrorFinder finder;
    add_jpeg(file, finder);
    expect_near(finder.find(), mirror);
  }
}

TEST(RealMirrors, AFisheyeWithoutARimIsNone) {
  AZIMUTH_REQUIRE_DATA("mirror-calibration/test_fisheye.jpg");
  MirrorFinder finder;
  add_jpeg(test::data_folder() / "mirror-calibration/test_fisheye.jpg", finder);
  EXPECT_FALSE(finder.find());
}

}  // namespace
}  // namespace azimuth
