#pragma once
// The loop of rank_update.hpp, included once for each instruction set it is compiled for. Everything here has internal
// linkage and uses nothing of the standard library, so that no code for one processor can be linked into another's.

#include "slam/ekf/rank_update.hpp"

namespace azimuth {
namespace {

using Index = Eigen::Index;
using Four = double __attribute__((vector_size(32)));

// Written out and not as loops: the sums must live in registers at any level of optimisation.
struct Tile {
  Four a0{}, a1{}, a2{}, a3{};  // rows 0 to 3 of four columns
  Four b0{}, b1{}, b2{}, b3{};  // rows 4 to 7
};

inline void load(Four& value, const double* from) { __builtin_memcpy(&value, from, sizeof value); }

inline void subtract(double* from, const Four& low, const Four& high) {
  Four a, b;
  load(a, from);
  load(b, from + 4);
  a -= low;
  b -= high;
  __builtin_memcpy(from, &a, sizeof a);
  __builtin_memcpy(from + 4, &b, sizeof b);
}

/// One element of the triangle.
inline void update_element(const LowerTriangle& A, const double* W, const double* Z, Index stride, Index columns,
                           Index row, Index column) {
  double sum = 0.0;
  for (Index k = 0; k < columns; ++k) sum += W[k * stride + row] * Z[k * stride + column];
  A.data[column * A.stride + row] -= sum;
}

/// Rows `row` to row+7 of columns `column` to column+3: each element of W loaded serves four products, and each element
/// of the triangle is read and written once.
inline void update_tile(const LowerTriangle& A, const double* W, const double* Z, Index stride, Index columns,
                        Index row, Index column) {
  Tile t;
  const double* w = W + row;
  const double* z = Z + column;
  for (Index k = 0; k < columns; ++k, w += stride, z += stride) {
    Four low, high;
    load(low, w);
    load(high, w + 4);
    t.a0 += low * z[0];
    t.b0 += high * z[0];
    t.a1 += low * z[1];
    t.b1 += high * z[1];
    t.a2 += low * z[2];
    t.b2 += high * z[2];
    t.a3 += low * z[3];
    t.b3 += high * z[3];
  }
  double* a = A.data + column * A.stride + row;
  subtract(a, t.a0, t.b0);
  subtract(a + A.stride, t.a1, t.b1);
  subtract(a + 2 * A.stride, t.a2, t.b2);
  subtract(a + 3 * A.stride, t.a3, t.b3);
}

inline void update_triangle(const LowerTriangle& A, const double* W, const double* Z, Index stride, Index columns) {
  const Index n = A.size;
  for (Index column = 0; column < n; column += 4) {
    const Index width = n - column < 4 ? n - column : 4;
    Index row = column + width;
    for (Index c = column; c < column + width; ++c)  // the triangle on the diagonal
      for (Index r = c; r < row; ++r) update_element(A, W, Z, stride, columns, r, c);
    if (width == 4)
      for (; row + 8 <= n; row += 8) update_tile(A, W, Z, stride, columns, row, column);
    for (Index c = column; c < column + width; ++c)  // rows left over
      for (Index r = row; r < n; ++r) update_element(A, W, Z, stride, columns, r, c);
  }
}

}  // namespace
}  // namespace azimuth
