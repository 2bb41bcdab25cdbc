#include "slam/perception/sift/own_sift.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/perception/sift/pictures.hpp"

namespace azimuth {
namespace {

struct Found {
  std::vector<KeyPoint> points;
  std::vector<Descriptor> descriptors;
};

Found found(OwnSift& sift, const Plane<std::uint16_t>& image) {
  Found result;
  sift.detect(image, test::whole_region(image.width()), result.points);
  sift.describe(result.points, result.descriptors);
  return result;
}

TEST(OwnSift, EveryProcessorFindsTheSame) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2 to compare with";
  Random random(1, RandomPurpose::scene);
  OwnSift portable({}, portable_scale_space_kernels()), avx2({}, avx2_scale_space_kernels());
  for (int trial = 0; trial < 3; ++trial) {
    const Plane<std::uint16_t> image = test::clutter(150 + 37 * trial, random);
    const Found a = found(portable, image), b = found(avx2, image);
    ASSERT_GT(a.points.size(), 20U);
    ASSERT_EQ(a.points.size(), b.points.size());
    const auto same = [](const KeyPoint& x, const KeyPoint& y) { return !stronger(x, y) && !stronger(y, x); };
    EXPECT_TRUE(std::ranges::equal(a.points, b.points, same));
    EXPECT_EQ(a.descriptors, b.descriptors);
  }
}

TEST(OwnSift, WhatWasSeenBeforeDoesNotMatter) {
  Random random(2, RandomPurpose::scene);
  const Plane<std::uint16_t> large = test::clutter(200, random), small = test::clutter(120, random);
  OwnSift fresh({}), used({});
  found(used, large);
  EXPECT_EQ(found(used, small).descriptors, found(fresh, small).descriptors);
}

}  // namespace
}  // namespace azimuth
