#include <array>
#include <gtest/gtest.h>

#include "tests/perception/sift/matches.hpp"
#include "tests/perception/sift/rigs.hpp"

namespace azimuth {
namespace {

/// Number of sectors with a feature, of twelve equal sectors of azimuth.
int sectors_seen(const BearingSet& set) {
  std::array<int, 12> features{};
  for (const Bearing& bearing : set.bearings)
    ++features[std::min<std::size_t>(11, static_cast<std::size_t>((bearing.azimuth_rad + kPi) / (kPi / 6.0)))];
  return static_cast<int>(std::ranges::count_if(features, [](int count) { return count > 0; }));
}

TEST(SiftOnRealImages, FindsFeaturesAllRound) {
  AZIMUTH_REQUIRE_DATA("mirror-images");
  AZIMUTH_REQUIRE_DATA("mirror-calibration");
  for (const test::RealImage& real : test::real_mirror_images()) {
    SiftPerception perception(real.rig, {});
    const test::SeenFeatures features = test::seen(perception, test::decoded(real).view());
    std::printf("%s: %zu features in %d of 12 sectors\n", real.file.c_str(), features.key_points.size(),
                sectors_seen(features.set));
    EXPECT_GE(features.key_points.size(), 60U) << real.file;
    EXPECT_LE(features.key_points.size(), 200U) << real.file;
    EXPECT_GE(sectors_seen(features.set), 10) << real.file;
  }
}

}  // namespace
}  // namespace azimuth
