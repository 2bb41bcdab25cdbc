// The hot loop of the EKF: at 500 landmarks it touches half a million elements a step. Four columns of the triangle
// are updated together, eight rows at a time, so that each element of W loaded serves four products and each element
// of the triangle is read and written once.
//
// The body is compiled twice, for the baseline and for AVX2, and chosen at run time: robots carry old computers.

#include "slam/ekf/rank_update.hpp"

#include <algorithm>
#include <cstring>

namespace azimuth {
namespace {

using Index = Eigen::Index;
using Four = double __attribute__((vector_size(32)));

[[gnu::always_inline]] inline void load(Four& value, const double* from) { std::memcpy(&value, from, sizeof value); }
[[gnu::always_inline]] inline void store(double* to, const Four& value) { std::memcpy(to, &value, sizeof value); }

/// One element of the triangle, in the same order of operations as the vector loop.
[[gnu::always_inline]] inline void update_element(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns,
                                                  Index row, Index column) {
  double sum = 0.0;
  for (Index k = 0; k < columns; ++k) sum += W[k * stride + row] * Z[k * stride + column];
  A.data[column * A.stride + row] -= sum;
}

/// Rows `row` to row+7 of columns `column` to column+3.
[[gnu::always_inline]] inline void update_tile(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns,
                                               Index row, Index column) {
  Four low[4] = {}, high[4] = {};
  for (Index k = 0; k < columns; ++k) {
    const double* w = W + k * stride;
    const double* z = Z + k * stride + column;
    Four rows_low, rows_high;
    load(rows_low, w + row);
    load(rows_high, w + row + 4);
    for (int c = 0; c < 4; ++c) {
      const double factor = z[c];
      low[c] += rows_low * factor;
      high[c] += rows_high * factor;
    }
  }
  for (int c = 0; c < 4; ++c) {
    double* a = A.data + (column + c) * A.stride + row;
    Four a_low, a_high;
    load(a_low, a);
    load(a_high, a + 4);
    store(a, a_low - low[c]);
    store(a + 4, a_high - high[c]);
  }
}

[[gnu::always_inline]] inline void update_all(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns) {
  const Index n = A.size;
  for (Index column = 0; column < n; column += 4) {
    const Index width = std::min<Index>(4, n - column);
    Index row = column + width;
    for (Index c = column; c < column + width; ++c)  // the triangle on the diagonal
      for (Index r = c; r < row; ++r) update_element(A, W, Z, stride, columns, r, c);
    if (width == 4)
      for (; row + 8 <= n; row += 8) update_tile(A, W, Z, stride, columns, row, column);
    for (Index c = column; c < column + width; ++c)  // rows left over
      for (Index r = row; r < n; ++r) update_element(A, W, Z, stride, columns, r, c);
  }
}

void update_baseline(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns) {
  update_all(A, W, Z, stride, columns);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void update_avx2(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns) {
  update_all(A, W, Z, stride, columns);
}
#endif

}  // namespace

void subtract_symmetric_product(LowerTriangle A, const double* W, const double* Z, Index stride, Index columns) {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return update_avx2(A, W, Z, stride, columns);
#endif
  update_baseline(A, W, Z, stride, columns);
}

}  // namespace azimuth
