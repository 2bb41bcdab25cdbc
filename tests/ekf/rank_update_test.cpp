#include "slam/ekf/rank_update.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "slam/ekf/rank_update_tile.hpp"  // the baseline path, which processors with AVX2 do not use
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

/// The definition: each element is summed over the columns in order with separate multiplications and additions, and
/// then subtracted. The project is compiled without floating-point contraction.
void subtract_by_definition(LowerTriangle A, SymmetricProduct product) {
  const auto W = [&](Index row, Index column) { return product.W[column * product.stride + row]; };
  for (Index column = 0; column < A.size; ++column)
    for (Index row = column; row < A.size; ++row) {
      double sum = 0.0;
      for (Index k = 0; k < product.squares; ++k) sum += W(row, k) * W(column, k);
      for (Index u = product.squares; u < product.squares + 2 * product.pairs; u += 2) {
        sum += W(row, u) * W(column, u + 1);
        sum += W(row, u + 1) * W(column, u);
      }
      A.data[column * A.stride + row] -= sum;
    }
}

void whiten_by_definition(double* W, Index stride, Index size, const double* L, Index L_stride, Index columns) {
  for (Index c = 0; c < columns; ++c)
    for (Index row = 0; row < size; ++row) {
      double rest = W[c * stride + row];
      for (Index k = 0; k < c; ++k) rest -= L[k * L_stride + c] * W[k * stride + row];
      W[c * stride + row] = rest / L[c * L_stride + c];
    }
}

struct Problem {
  Index size, stride, columns, pairs, L_stride;  // pairs: number of column pairs
  std::vector<double> A, W, L;

  Problem(Index size_in, Index columns_in, RandomDraws& draws)
      : size(size_in),
        stride(LowerTriangle::padded(size_in) + draws.integer(0, 9)),
        columns(columns_in),
        pairs(draws.integer(0, static_cast<int>(columns_in / 2))),
        L_stride(columns_in + draws.integer(0, 3)) {
    fill(A, stride * LowerTriangle::padded(size), draws);
    fill(W, stride * columns, draws);
    fill(L, L_stride * columns, draws);
    for (Index k = 0; k < columns; ++k)  // the large diagonal keeps rounding errors from growing
      L[static_cast<std::size_t>(k * (L_stride + 1))] = draws.uniform(3.0, 4.0) * static_cast<double>(columns);
  }
  std::vector<double> result_of(decltype(&subtract_by_definition) subtract) const {
    std::vector<double> result = A;
    subtract({result.data(), size, stride}, {W.data(), stride, columns - 2 * pairs, pairs});
    std::vector<double> triangle;
    for (Index column = 0; column < size; ++column)
      for (Index row = column; row < size; ++row)
        triangle.push_back(result[static_cast<std::size_t>(column * stride + row)]);
    return triangle;
  }
  std::vector<double> result_of(decltype(&whiten_by_definition) whiten) const {
    std::vector<double> result = W, rows;
    whiten(result.data(), stride, size, L.data(), L_stride, columns);
    for (Index column = 0; column < columns; ++column)
      for (Index row = 0; row < size; ++row) rows.push_back(result[static_cast<std::size_t>(column * stride + row)]);
    return rows;
  }

 private:
  static void fill(std::vector<double>& values, Index count, RandomDraws& draws) {
    values.resize(static_cast<std::size_t>(count));
    for (double& value : values) value = draws.normal();
  }
};

void subtract_by_baseline(LowerTriangle A, SymmetricProduct product) { update_triangle(A, product); }

void whiten_by_baseline(double* W, Index stride, Index size, const double* L, Index L_stride, Index columns) {
  whiten_all_rows(W, stride, size, L, L_stride, columns);
}

/// The baseline must agree to the last bit. The other paths use fused multiply-adds, which round once instead of twice.
template <class Function>
void expect_paths_agree(const Problem& problem, Function by_definition, Function baseline, Function chosen,
                        [[maybe_unused]] Function avx2, [[maybe_unused]] Function avx512) {
  SCOPED_TRACE(testing::Message() << problem.size << " x " << problem.columns);
  const std::vector<double> expected = problem.result_of(by_definition);
  EXPECT_EQ(problem.result_of(baseline), expected);
  const std::vector<double> result = problem.result_of(chosen);
  const double rounding = 1e-15 * static_cast<double>(8 + 16 * problem.columns);
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(result[i], expected[i], rounding) << i;
#if defined(__x86_64__)
  const bool has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  if (has_avx2) {
    EXPECT_EQ(problem.result_of(avx2), result);
  }
  if (has_avx2 && __builtin_cpu_supports("avx512f") != 0) {
    EXPECT_EQ(problem.result_of(avx512), result);
  }
#endif
}

void expect_every_path_agrees(Index size, Index columns, RandomDraws& draws) {
  const Problem problem(size, columns, draws);
  expect_paths_agree(problem, &subtract_by_definition, &subtract_by_baseline, &subtract_symmetric_product,
                     &avx2::subtract_symmetric_product, &avx512::subtract_symmetric_product);
  expect_paths_agree(problem, &whiten_by_definition, &whiten_by_baseline, &whiten_columns, &avx2::whiten_columns,
                     &avx512::whiten_columns);
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

/// Zero columns are a special case, because the kernels require at least one column.
TEST(RankUpdate, WithoutColumnsChangesNothing) {
  RandomDraws draws(53);
  const Problem problem(9, 0, draws);
  EXPECT_EQ(problem.result_of(&subtract_symmetric_product), problem.result_of(&subtract_by_definition));
  EXPECT_EQ(problem.result_of(&whiten_columns), problem.result_of(&whiten_by_definition));
}

}  // namespace
}  // namespace azimuth
