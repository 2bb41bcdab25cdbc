#include <Eigen/Cholesky>
#include <bit>
#include <gtest/gtest.h>

#include "slam/association/chi_square.hpp"
#include "slam/association/joint_compatibility.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kProbability = 0.99;

using Flags = std::vector<std::uint8_t>;

/// Innovations drawn from their covariance S, without outliers.
struct Batch {
  std::vector<double> innovations;
  Eigen::MatrixXd S;
};

Batch consistent_batch(RandomDraws& draws, int size) {
  Batch batch;
  batch.S = draws.covariance(size, 0.05);
  const Eigen::VectorXd nu = batch.S.llt().matrixL() * draws.normals(size);
  batch.innovations.assign(nu.begin(), nu.end());
  return batch;
}

bool passes(const Batch& batch, unsigned subset) {
  const int size = std::popcount(subset);
  if (size == 0) return true;
  std::vector<Eigen::Index> members;
  for (std::size_t i = 0; i < batch.innovations.size(); ++i)
    if ((subset >> i & 1u) != 0) members.push_back(static_cast<Eigen::Index>(i));
  const Eigen::Map<const Eigen::VectorXd> all(batch.innovations.data(), batch.S.rows());
  const Eigen::VectorXd nu = all(members);
  return nu.dot(batch.S(members, members).ldlt().solve(nu)) <= chi_square_quantile(size, kProbability);
}

unsigned subset_of(const Flags& accepted) {
  unsigned subset = 0;
  for (std::size_t i = 0; i < accepted.size(); ++i) subset |= static_cast<unsigned>(accepted[i]) << i;
  return subset;
}

Flags prune(const Batch& batch) {
  JointTest test;
  Flags accepted;
  test.prune(batch.innovations, batch.S, kProbability, accepted);
  return accepted;
}

int largest_passing(const Batch& batch) {
  int largest = 0;
  for (unsigned subset = 0; subset < 1u << batch.innovations.size(); ++subset)
    if (std::popcount(subset) > largest && passes(batch, subset)) largest = std::popcount(subset);
  return largest;
}

TEST(JointTest, LeavesAConsistentBatchAlone) {
  RandomDraws draws(31);
  int consistent = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Batch batch = consistent_batch(draws, draws.integer(1, 8));
    const auto everyone = (1u << batch.innovations.size()) - 1;
    if (!passes(batch, everyone)) continue;  // happens in 1 of 100 batches, by the confidence
    ++consistent;
    EXPECT_EQ(subset_of(prune(batch)), everyone);
  }
  EXPECT_GT(consistent, 285);
}

TEST(JointTest, RemovesASingleOutlierAndNothingElse) {
  RandomDraws draws(32);
  for (int trial = 0; trial < 300; ++trial) {
    Batch batch = consistent_batch(draws, draws.integer(3, 8));
    const auto size = static_cast<int>(batch.innovations.size());
    const int outlier = draws.integer(0, size - 1);
    const unsigned others = ((1u << size) - 1) & ~(1u << outlier);
    if (!passes(batch, others)) continue;
    batch.innovations[static_cast<std::size_t>(outlier)] += 30.0 * std::sqrt(batch.S(outlier, outlier));
    ASSERT_EQ(largest_passing(batch), size - 1);
    EXPECT_EQ(subset_of(prune(batch)), others);
  }
}

TEST(JointTest, WhatIsLeftPassesAndIsNearlyAlwaysTheLargestSubset) {
  RandomDraws draws(33);
  int trials = 0, as_large = 0;
  for (; trials < 300; ++trials) {
    Batch batch = consistent_batch(draws, draws.integer(2, 8));
    for (double& innovation : batch.innovations)
      if (draws.chance(0.25)) innovation += draws.normal(0.5);
    const unsigned accepted = subset_of(prune(batch));
    EXPECT_TRUE(std::popcount(accepted) == 1 || passes(batch, accepted));
    EXPECT_GE(std::popcount(accepted), 1);  // a single innovation is judged by its individual gate
    as_large += std::popcount(accepted) >= largest_passing(batch) ? 1 : 0;
  }
  EXPECT_GE(as_large, trials * 95 / 100);
}

TEST(JointTest, DoesNotDependOnTheOrder) {
  RandomDraws draws(34);
  for (int trial = 0; trial < 100; ++trial) {
    Batch batch = consistent_batch(draws, 6);
    batch.innovations[1] += 0.4;
    batch.innovations[4] -= 0.3;
    const Flags accepted = prune(batch);
    Batch reversed = batch;
    std::reverse(reversed.innovations.begin(), reversed.innovations.end());
    reversed.S = batch.S.reverse().eval();
    const Flags backwards = prune(reversed);
    EXPECT_TRUE(std::equal(accepted.rbegin(), accepted.rend(), backwards.begin()));
  }
}

TEST(JointTest, NothingInNothingOut) { EXPECT_TRUE(prune({{}, Eigen::MatrixXd(0, 0)}).empty()); }

}  // namespace
}  // namespace azimuth
