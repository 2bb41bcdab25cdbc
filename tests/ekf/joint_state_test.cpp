// Compares JointState, with its gaps, their reuse and its growth, with the dense textbook filter over random sequences
// of operations.

#include <gtest/gtest.h>
#include <string>

#include "tests/ekf/state_twins.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using Retraction = JointState::Retraction;

class RandomOperations : public testing::TestWithParam<std::tuple<int, Retraction>> {};

TEST_P(RandomOperations, AgreeWithTheDenseFilter) {
  const auto [seed, retraction] = GetParam();
  Twins twins(static_cast<unsigned>(seed), retraction);
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    SCOPED_TRACE("operation " + std::to_string(i));
    twins.step();
    twins.expect_equal();
    twins.expect_gaps_are_zero();
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomOperations,
                         testing::Combine(testing::Range(1, 21),
                                          testing::Values(Retraction::additive, Retraction::invariant)),
                         test::PrintedName());

class Growth : public testing::TestWithParam<Retraction> {};

TEST_P(Growth, KeepsEverythingAcrossEachDoubling) {
  Twins twins(100, GetParam());
  for (int i = 0; twins.state.extent() < 280 && !HasFailure(); ++i) {  // grows past 64, 128 and 256 entries
    const Index before = twins.state.extent();
    twins.add(i % 3 == 0 ? BlockKind::inverse_depth : BlockKind::point);
    if (i % 4 == 0) twins.clone();
    if (i % 10 == 9) twins.update(5);
    const bool doubled = (before <= 64) != (twins.state.extent() <= 64) ||
                         (before <= 128) != (twins.state.extent() <= 128) ||
                         (before <= 256) != (twins.state.extent() <= 256);
    if (doubled) twins.expect_equal();
  }
  twins.expect_equal();
}
INSTANTIATE_TEST_SUITE_P(Both, Growth, testing::Values(Retraction::additive, Retraction::invariant),
                         test::PrintedName());

TEST(JointStateGaps, AreReusedByBlocksOfTheirSize) {
  Twins twins(101, Retraction::additive);
  for (int i = 0; i < 10; ++i) {
    twins.add(BlockKind::point);
    twins.clone();
    twins.add(BlockKind::inverse_depth);
  }
  const Index full = twins.state.extent();
  for (int round = 0; round < 50; ++round) {
    for (int removed = 0; removed < 6; ++removed) twins.remove(1);
    for (int added = 0; added < 2; ++added) {
      twins.add(BlockKind::point);
      twins.clone();
      twins.add(BlockKind::inverse_depth);
    }
    ASSERT_EQ(twins.state.extent(), full) << "nothing may grow with the length of the run";
  }
  twins.expect_equal();
}

TEST(JointStateGaps, HalfOfAPromotedRayServesAPoint) {
  Twins twins(102, Retraction::additive);
  twins.add(BlockKind::inverse_depth);
  const Index ray = twins.offset(1), extent = twins.state.extent();
  twins.promote_one();
  EXPECT_EQ(twins.offset(1), ray);
  twins.expect_gaps_are_zero();
  twins.add(BlockKind::point);
  EXPECT_EQ(twins.offset(2), ray + 2);
  EXPECT_EQ(twins.state.extent(), extent);
  twins.expect_equal();
}

/// Two rows on the robot and one point, so that the parts of two pairs coincide or lie on either side of the diagonal.
RowPair pair_on(Index block, double by) {
  RowPair rows;
  for (std::size_t axis = 0; axis < rows.size(); ++axis) {
    const double sign = axis == 0 ? by : -0.7 * by;
    rows[axis].add(block, std::array{0.9 * sign, 0.4});
    rows[axis].add(JointState::kPose, std::array{0.1, 0.2 * sign, -1.0});
  }
  return rows;
}

TEST(JointStateCovariance, OfPairsOfRowsIsThatOfEachByEachToTheLastBit) {
  Twins twins(104, Retraction::additive);
  for (int i = 0; i < 6; ++i) twins.add(BlockKind::point);
  for (int i = 0; i < 10; ++i) twins.step();
  std::size_t correlated = 0;
  for (const int i : {0, 2, 5})
    for (const int j : {0, 2, 5}) {
      const RowPair a = pair_on(twins.offset(i), 1.0), b = pair_on(twins.offset(j), 0.3);
      const Eigen::Matrix2d by_pair = twins.state.covariance(a, b);
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) {
          double dense = 0.0;
          for (int p = 0; p < 2; ++p)
            for (int q = 0; q < 2; ++q) {
              const auto &pa = a[as_size(r)].parts[as_size(p)], &pb = b[as_size(c)].parts[as_size(q)];
              for (Index k = 0; k < pa.size; ++k)
                for (Index l = 0; l < pb.size; ++l)
                  dense += pa.coefficients[as_size(k)] * pb.coefficients[as_size(l)] *
                           twins.state.covariance(pa.offset + k, pb.offset + l);
            }
          EXPECT_EQ(by_pair(r, c), dense);
          EXPECT_EQ(twins.state.covariance(a[as_size(r)], b[as_size(c)]), dense);
          correlated += dense != 0.0 ? 1 : 0;
        }
    }
  EXPECT_EQ(correlated, 36u);
}

TEST(JointStateUpdate, WithoutAPositiveInnovationCovarianceChangesNothing) {
  Twins twins(103, Retraction::invariant);
  for (int i = 0; i < 5; ++i) twins.add(BlockKind::point);
  ObservationRow good, bad;
  const std::array h{0.1, 0.2, -1.0};
  good.add(JointState::kPose, h);
  good.innovation = 0.3;
  good.variance = 0.01;
  bad = good;
  bad.variance = -1e3;
  const std::array rows{good, bad};
  EXPECT_FALSE(twins.state.update(rows, Retraction::invariant));
  twins.expect_equal();
  EXPECT_TRUE(twins.state.update({}, Retraction::invariant));
  twins.expect_equal();
}

TEST(JointStateUpdate, ManyMoreRowsThanEverBefore) {
  Twins twins(104, Retraction::additive);
  for (int i = 0; i < 8; ++i) twins.add(BlockKind::point);
  for (const int rows : {1, 17, 40, 3}) {
    twins.update(rows);
    twins.expect_equal();
  }
}

}  // namespace
}  // namespace azimuth
