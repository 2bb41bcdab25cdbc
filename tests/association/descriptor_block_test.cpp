#include "slam/association/descriptor_block.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "slam/association/descriptor_loops.hpp"
#include "tests/association/random_descriptors.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kLanes = DescriptorBlock::kLanes;

struct BlockProblem {
  std::array<Descriptor, kLanes> stored;
  std::array<Descriptor, kQueriesAtOnce> wanted;
  std::array<std::int32_t, kQueriesAtOnce> bounds{};
};

BlockProblem random_problem(RandomDraws& draws) {
  BlockProblem problem;
  for (Descriptor& descriptor : problem.stored) descriptor = random_descriptor(draws);
  for (Descriptor& descriptor : problem.wanted)
    descriptor = seen_again(problem.stored[static_cast<std::size_t>(draws.integer(0, 15))], 20.0, draws);
  // each bound equals one lane's distance: `near` means strictly below
  for (std::size_t q = 0; q < kQueriesAtOnce; ++q)
    problem.bounds[q] = squared_distance(problem.wanted[q], problem.stored[static_cast<std::size_t>(3 * q)]);
  return problem;
}

/// The largest products and differences that descriptor values allow.
BlockProblem extreme_problem() {
  BlockProblem problem;
  for (std::size_t lane = 0; lane < kLanes; lane += 2) problem.stored[lane].values.fill(255);
  problem.wanted[0].values.fill(255);
  problem.wanted[2].values.fill(128);
  problem.wanted[3].values.fill(127);
  problem.bounds.fill(std::numeric_limits<std::int32_t>::max());
  return problem;
}

void expect_equals_definition(const BlockProblem& problem, decltype(&find_near) find) {
  DescriptorBlock block;
  std::array<DescriptorQuery, kQueriesAtOnce> queries;
  for (std::size_t lane = 0; lane < kLanes; ++lane) block.set(lane, problem.stored[lane]);
  for (std::size_t q = 0; q < kQueriesAtOnce; ++q) queries[q] = DescriptorQuery(problem.wanted[q]);
  NearLanes found;
  find(block, queries.data(), problem.bounds.data(), found);
  for (std::size_t q = 0; q < kQueriesAtOnce; ++q)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::int32_t distance2 = squared_distance(problem.wanted[q], problem.stored[lane]);
      ASSERT_EQ(found.squared_distance[q][lane], distance2) << "query " << q << ", lane " << lane;
      ASSERT_EQ((found.near[q] >> lane & 1U) != 0, distance2 < problem.bounds[q]) << "query " << q << ", lane " << lane;
    }
}

void expect_dot_equals_definition(const BlockProblem& problem, decltype(&dot_product) dot) {
  for (const Descriptor& a : problem.stored)
    for (const Descriptor& b : problem.wanted) {
      std::int32_t sum = 0;
      for (std::size_t i = 0; i < a.values.size(); ++i) sum += a.values[i] * b.values[i];
      ASSERT_EQ(dot(a, b), sum);
    }
}

void expect_every_path_agrees(const BlockProblem& problem) {
  expect_equals_definition(problem, find_near);
  expect_equals_definition(problem, portable::find_near);
  expect_dot_equals_definition(problem, dot_product);
  expect_dot_equals_definition(problem, portable::dot_product);
  if (avx2::supported()) {
    expect_equals_definition(problem, avx2::find_near);
    expect_dot_equals_definition(problem, avx2::dot_product);
  }
  if (avx512::supported()) expect_equals_definition(problem, avx512::find_near);
  if (neon::supported()) {
    expect_equals_definition(problem, neon::find_near);
    expect_dot_equals_definition(problem, neon::dot_product);
  }
}

TEST(DescriptorBlock, DistancesAreExactOnEveryPath) {
  RandomDraws draws(61);
  for (int k = 0; k < 50; ++k) expect_every_path_agrees(random_problem(draws));
}

TEST(DescriptorBlock, LargestDifferencesDoNotOverflow) { expect_every_path_agrees(extreme_problem()); }

TEST(DescriptorBlock, GivesBackWhatWasPutIn) {
  RandomDraws draws(62);
  DescriptorBlock block;
  std::vector<Descriptor> stored;
  for (std::size_t lane = 0; lane < kLanes; ++lane) block.set(lane, stored.emplace_back(random_descriptor(draws)));
  for (std::size_t lane = 0; lane < kLanes; ++lane) EXPECT_EQ(block.get(lane), stored[lane]);
}

}  // namespace
}  // namespace azimuth
