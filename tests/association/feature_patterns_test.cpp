#include "slam/association/feature_patterns.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "tests/association/random_descriptors.hpp"

namespace azimuth {
namespace {

std::vector<double> as_numbers(const Descriptor& descriptor) {
  return {descriptor.values.begin(), descriptor.values.end()};
}

TEST(FeaturePatterns, CorrelationOfDescriptorsEqualsTheDefinition) {
  RandomDraws draws(81);
  for (int k = 0; k < 200; ++k) {
    const Descriptor a = random_descriptor(draws);
    const Descriptor b = k % 2 == 0 ? random_descriptor(draws) : seen_again(a, draws.uniform(1.0, 60.0), draws);
    EXPECT_NEAR(correlation(a, b), correlation(as_numbers(a), as_numbers(b)), 1e-12);
  }
}

TEST(FeaturePatterns, CorrelationKnowsBrightnessAndContrastNot) {
  RandomDraws draws(82);
  Descriptor a = random_descriptor(draws), b, c;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    a.values[i] = static_cast<std::uint8_t>(a.values[i] / 2);
    b.values[i] = static_cast<std::uint8_t>(a.values[i] * 2);
    c.values[i] = static_cast<std::uint8_t>(255 - b.values[i]);
  }
  EXPECT_NEAR(correlation(a, b), 1.0, 1e-12);
  EXPECT_NEAR(correlation(a, c), -1.0, 1e-12);
}

TEST(FeaturePatterns, AConstantCorrelatesWithNothing) {
  RandomDraws draws(83);
  Descriptor constant;
  constant.values.fill(17);
  EXPECT_EQ(correlation(constant, constant), 0.0);
  EXPECT_EQ(correlation(constant, random_descriptor(draws)), 0.0);
}

TEST(FeaturePatterns, CountsMembersSeenAgainInAnyOrder) {
  RandomDraws draws(84);
  std::vector<Descriptor> first, second;
  for (int k = 0; k < 5; ++k) first.push_back(random_descriptor(draws));
  for (const int again : {4, 1, 1}) second.push_back(seen_again(first[static_cast<std::size_t>(again)], 10.0, draws));
  EXPECT_EQ(matched_members(first, second, 0.8), 2u);  // members 1 and 4
  EXPECT_EQ(matched_members(second, first, 0.8), 3u);  // one member may match several
  EXPECT_EQ(matched_members(first, second, 0.999), 0u);
  EXPECT_EQ(matched_members(first, std::vector<Descriptor>{}, 0.8), 0u);
}

TEST(FeaturePatterns, PatternLeavesOutNeighboursThatAreNotThere) {
  RandomDraws draws(85);
  BearingSet image;
  for (int k = 0; k < 3; ++k) image.descriptors.push_back(random_descriptor(draws));
  image.neighbours.resize(3);
  // 9: an index outside the set must be ignored
  image.neighbours[0].index = {2, 1, Neighbours::kNone, Neighbours::kNone, 9};
  const Pattern pattern = pattern_of(image, 0);
  ASSERT_EQ(pattern.count, 2u);
  EXPECT_EQ(pattern.members[0], image.descriptors[2]);
  EXPECT_EQ(pattern.members[1], image.descriptors[1]);
  EXPECT_EQ(pattern_of(image, 1).count, 0u);
  EXPECT_EQ(pattern_of(image, 7).count, 0u);
}

}  // namespace
}  // namespace azimuth
