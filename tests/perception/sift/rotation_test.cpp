// A robot that turns on the spot rotates its image about the mirror's centre: features must be matched again
// (mathematics I.12).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>

#include "tests/perception/rotated_image.hpp"
#include "tests/perception/sift/matches.hpp"
#include "tests/perception/sift/rigs.hpp"

namespace azimuth {
namespace {

using test::Image;

constexpr double kRatio = 0.8;

/// A front end's features of an image, and the number of them that match after a rotation of the image.
class Turned {
 public:
  Turned(const Image& image, const CameraRig& rig, const SiftSettings& settings) : perception_(rig, settings) {
    before_ = test::seen(perception_, image.view());
    unturned_ = found_again(image, 0.0).right;
  }

  const Pixel& centre() const { return perception_.working_square().axes.centre_px; }
  int features() const { return static_cast<int>(before_.key_points.size()); }
  /// Share of the correct matches, relative to those of the image with itself.
  double share_kept(const Image& turned, double angle_rad) {
    return 1.0 * found_again(turned, angle_rad).right / std::max(1, unturned_);
  }

 private:
  test::MatchCount found_again(const Image& turned, double angle_rad) {
    const test::SeenFeatures after = test::seen(perception_, turned.view());
    const double middle_px = perception_.working_square().middle_px();
    return test::count_matches(before_, after, kRatio, [&](std::size_t i, std::size_t j) {
      const KeyPoint &from = before_.key_points[i], &to = after.key_points[j];
      const double x = from.x_px - middle_px, y = from.y_px - middle_px;
      const double turned_x = std::cos(angle_rad) * x - std::sin(angle_rad) * y;
      const double turned_y = std::sin(angle_rad) * x + std::cos(angle_rad) * y;
      const double off_px = std::hypot(to.x_px - middle_px - turned_x, to.y_px - middle_px - turned_y);
      return off_px < std::max(2.0, 0.25 * from.sigma_px);
    });
  }

  SiftPerception perception_;
  test::SeenFeatures before_;
  int unturned_ = 0;
};

/// The paper's settings, except the contrast, with which hardly any feature remains, and the number of features.
SiftSettings literal() {
  SiftSettings settings = paper_sift_preset();
  settings.contrast = SiftSettings{}.contrast;
  settings.target_count = SiftSettings{}.target_count;
  return settings;
}

void expect_kept(const std::string& name, const Image& image, const CameraRig& rig) {
  Turned ours(image, rig, {}), papers(image, rig, literal());
  constexpr std::array kAngles_rad{0.3, 1.0, 2.4, 4.0, 5.5};
  double all_kept = 0.0;
  for (const double angle_rad : kAngles_rad) {
    const Image turned = test::rotated(image, ours.centre(), angle_rad);
    const double kept = ours.share_kept(turned, angle_rad), literally = papers.share_kept(turned, angle_rad);
    std::printf("%s turned by %.1f rad: default keeps %.0f %% of %d, literal %.0f %% of %d\n", name.c_str(), angle_rad,
                100 * kept, ours.features(), 100 * literally, papers.features());
    EXPECT_GE(kept, 0.75) << name << " " << angle_rad;
    EXPECT_LT(literally, angle_rad < 0.5 ? kept : 0.1) << name << " " << angle_rad;
    all_kept += kept;
  }
  EXPECT_GE(all_kept / kAngles_rad.size(), 0.8) << name;
}

TEST(SiftRotation, KeepsMatchesOfARenderedRoom) {
  for (const Pose2& T_world_body : {Pose2{5.0, 2.0, 0.0}, Pose2{12.0, 6.0, 1.5}})
    expect_kept("lab", test::rendered(test::lab_scene(), test::mirror_camera(), T_world_body), test::lab_mirror_rig());
}

TEST(SiftRotation, KeepsMatchesOfRealImages) {
  AZIMUTH_REQUIRE_DATA("mirror-images");
  AZIMUTH_REQUIRE_DATA("mirror-calibration");
  for (const test::RealImage& real : test::real_mirror_images())
    if (real.for_rotation) expect_kept(real.file, test::decoded(real), real.rig);
}

}  // namespace
}  // namespace azimuth
