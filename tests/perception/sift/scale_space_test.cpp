#include "slam/perception/sift/scale_space.hpp"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>

#include "tests/perception/sift/pictures.hpp"

namespace azimuth {
namespace {

using test::Blob;

bool same_bits(const Plane<float>& a, const Plane<float>& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (int y = 0; y < a.height(); ++y)
    if (std::memcmp(a.row(y), b.row(y), sizeof(float) * static_cast<std::size_t>(a.width())) != 0) return false;
  return true;
}

TEST(ScaleSpace, EveryProcessorComputesTheSameBits) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2 to compare with";
  Random random(1, RandomPurpose::scene);
  ScaleSpace portable({}, portable_scale_space_kernels()), avx2({}, avx2_scale_space_kernels());
  for (const int side_px : {4, 5, 31, 32, 33, 100, 257}) {
    const Plane<std::uint16_t> image = test::noise(side_px, random);
    portable.build(image);
    avx2.build(image);
    ASSERT_EQ(portable.octaves(), avx2.octaves());
    for (int o = 0; o < avx2.octaves(); ++o) {
      for (int i = 0; i <= avx2.scales() + 2; ++i)
        ASSERT_TRUE(same_bits(portable.gaussian(o, i), avx2.gaussian(o, i))) << side_px << " " << o << " " << i;
      for (int i = 0; i <= avx2.scales() + 1; ++i)
        ASSERT_TRUE(same_bits(portable.difference(o, i), avx2.difference(o, i))) << side_px << " " << o << " " << i;
    }
  }
}

TEST(ScaleSpace, FindExtremaIsWhatItSays) {
  Random random(2, RandomPurpose::scene);
  ScaleSpace space({});
  space.build(test::clutter(161, random));
  const float threshold = 0.002F;
  Neighbourhood around{};
  const auto expected_at = [&](int x) {
    const float value = around.rows[4][x];
    bool high = true, low = true;
    for (const float* row : around.rows) {
      for (int i = x - 1; i <= x + 1; ++i) {
        high = high && value >= row[i];
        low = low && value <= row[i];
      }
    }
    return (value > threshold && high) || (value < -threshold && low);
  };
  int found_in_all = 0;
  for (int y = 1; y < 160; ++y) {
    for (int i = 0; i < 9; ++i) around.rows[i] = space.difference(0, 1 + i / 3).row(y - 1 + i % 3);
    std::vector<std::int32_t> expected;
    for (int x = 1; x < 160; ++x)
      if (expected_at(x)) expected.push_back(x);
    for (const ScaleSpaceKernels* kernels : {&portable_scale_space_kernels(), &scale_space_kernels()}) {
      std::vector<std::int32_t> found(161);
      found.resize(static_cast<std::size_t>(kernels->find_extrema(around, 1, 160, threshold, found.data())));
      EXPECT_EQ(found, expected) << y;
    }
    found_in_all += static_cast<int>(expected.size());
  }
  EXPECT_GT(found_in_all, 15);
}

TEST(ScaleSpace, BlursAddUp) {
  const double sigma_px = 6.0, amplitude = 80.0 / 255.0;
  ScaleSpace space({});
  space.build(test::picture(160, {Blob{80.0, 80.0, sigma_px, 80.0}}));
  const double camera_px = SiftSettings{}.camera_sigma_px;
  for (int octave = 0; octave < 2; ++octave) {
    const double step = 1 << octave;
    for (int i = 0; i <= space.scales() + 2; ++i) {
      const double blur_px = step * space.sigma_px(static_cast<float>(i));
      const double variance = sigma_px * sigma_px + blur_px * blur_px - camera_px * camera_px;
      const double expected = 128.0 / 255.0 + amplitude * sigma_px * sigma_px / variance;
      const int middle = 80 >> octave;
      EXPECT_NEAR(space.gaussian(octave, i).at(middle, middle), expected, 1.5e-3) << octave << " " << i;
    }
  }
}

TEST(ScaleSpace, DifferencesAreThose) {
  Random random(3, RandomPurpose::scene);
  ScaleSpace space({});
  space.build(test::noise(70, random));
  for (int o = 0; o < space.octaves(); ++o)
    for (int i = 0; i <= space.scales() + 1; ++i)
      for (int x = 0; x < space.difference(o, i).width(); ++x)
        ASSERT_EQ(space.difference(o, i).at(x, 2), space.gaussian(o, i + 1).at(x, 2) - space.gaussian(o, i).at(x, 2));
}

TEST(ScaleSpace, OneGreyStaysOneGrey) {
  ScaleSpace space({});
  space.build(test::picture(64, {}));
  for (int o = 0; o < space.octaves(); ++o)
    for (int i = 0; i <= space.scales() + 1; ++i)
      for (int y = 0; y < space.difference(o, i).height(); ++y)
        ASSERT_NEAR(space.difference(o, i).at(y, y), 0.0F, 1e-6F);
}

TEST(ScaleSpace, PaperHasSevenOctavesDownToSevenPixels) {
  ScaleSpace space(paper_sift_preset());
  space.build(test::picture(480, {}));
  ASSERT_EQ(space.octaves(), 7);
  EXPECT_EQ(space.scales() + 3, 5) << "images of an octave";
  EXPECT_EQ(space.gaussian(6, 0).width(), 7);
}

}  // namespace
}  // namespace azimuth
