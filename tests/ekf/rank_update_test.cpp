#include "slam/ekf/rank_update.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "slam/ekf/rank_update_avx2.hpp"
#include "slam/ekf/rank_update_tile.hpp"  // the baseline path, which does not run on a processor with AVX2
#include "tests/geometry/random_draws.hpp"

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

void subtract_by_baseline(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns) {
  update_triangle(A, W, Z, stride, columns);
}

/// The baseline agrees bit by bit; fused multiply-adds round once instead of twice. Outside of the triangle nothing is
/// touched: the definition leaves that alone.
void expect_every_path_agrees(Index size, Index columns, RandomDraws& draws) {
  const Problem problem(size, columns, draws);
  const std::vector<double> expected = problem.result_of(subtract_by_definition);
  EXPECT_EQ(problem.result_of(subtract_by_baseline), expected) << size << " x " << columns;
  const std::vector<double> chosen = problem.result_of(subtract_symmetric_product);
  const double rounding = 1e-15 * static_cast<double>(8 + 16 * columns);
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(chosen[i], expected[i], rounding) << i;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    EXPECT_EQ(problem.result_of(subtract_symmetric_product_avx2), chosen) << size << " x " << columns;
  }
#endif
}

TEST(RankUpdate, EqualsItsDefinition) {
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
