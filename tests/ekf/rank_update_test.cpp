#include "slam/ekf/rank_update.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "tests/geometry/random_draws.hpp"

// The baseline path does not run on a processor with AVX2. Both paths are one source compiled twice; a second copy of
// it, under another name, lets this test call each.
#define subtract_symmetric_product second_copy_of_subtract_symmetric_product
#include "slam/ekf/rank_update.cpp"
#undef subtract_symmetric_product

namespace azimuth {
namespace {

/// The definition: each element summed over the columns in order, by separate multiplications and additions (the
/// project is compiled without contraction), then subtracted.
void subtract_by_definition(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns) {
  for (Index column = 0; column < A.size; ++column)
    for (Index row = column; row < A.size; ++row) {
      double sum = 0.0;
      for (Index k = 0; k < columns; ++k) sum += W[k * stride + row] * Z[k * stride + column];
      A.data[column * A.stride + row] -= sum;
    }
}

struct Problem {
  Index size, stride, columns;
  std::vector<double> A, W, Z;

  Problem(Index size_in, Index columns_in, RandomDraws& draws)
      : size(size_in), stride(size_in + draws.integer(0, 9)), columns(columns_in) {
    for (std::vector<double>* values : {&A, &W, &Z}) {
      values->resize(static_cast<std::size_t>(stride * std::max(size, columns)));
      for (double& value : *values) value = draws.normal();
    }
  }
  std::vector<double> result_of(decltype(&subtract_by_definition) subtract) const {
    std::vector<double> result = A;
    subtract({result.data(), size, stride}, W.data(), Z.data(), stride, columns);
    return result;
  }
};

/// Bit by bit, and outside of the triangle nothing touched: the definition leaves that alone.
void expect_every_path_agrees(Index size, Index columns, RandomDraws& draws) {
  const Problem problem(size, columns, draws);
  const std::vector<double> expected = problem.result_of(subtract_by_definition);
  EXPECT_EQ(problem.result_of(subtract_symmetric_product), expected) << size << " x " << columns;
  EXPECT_EQ(problem.result_of(update_baseline), expected) << size << " x " << columns;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0) {
    EXPECT_EQ(problem.result_of(update_avx2), expected) << size << " x " << columns;
  }
#endif
  EXPECT_EQ(problem.result_of(second_copy_of_subtract_symmetric_product), expected) << size << " x " << columns;
}

TEST(RankUpdate, EqualsItsDefinitionBitByBit) {
  RandomDraws draws(51);
  for (Index size = 1; size <= 70; ++size)
    for (const Index columns : {1, 2, 3, 4, 7, 8, 12, 22}) expect_every_path_agrees(size, columns, draws);
}

TEST(RankUpdate, LargeMatrices) {
  RandomDraws draws(52);
  for (const Index size : {255, 256, 259, 515}) expect_every_path_agrees(size, 12, draws);
}

TEST(RankUpdate, WithoutColumnsChangesNothing) {
  RandomDraws draws(53);
  expect_every_path_agrees(9, 0, draws);
}

}  // namespace
}  // namespace azimuth
