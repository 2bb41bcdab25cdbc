#pragma once
// The loops of rank_update.hpp (see lanes.hpp).

#include "slam/ekf/lanes.hpp"
#include "slam/ekf/rank_update.hpp"

namespace azimuth {
namespace {

// NOLINTBEGIN(misc-definitions-in-headers): a copy for each instruction set is intended
constexpr int kDeep = 3, kColumns = 4;   // rows, in registers, and columns of a tile
constexpr Index kRows = kDeep * kLanes;  // rows of a tile
// Elements this many rows further down are prefetched before a tile is computed, which halves the time for 1000
// landmarks.
constexpr Index kAhead = 3 * kRows, kLine = 8;
// NOLINTEND(misc-definitions-in-headers)
static_assert(LowerTriangle::kTile % kLanes == 0 && LowerTriangle::kTile % kColumns == 0);

/// Sums of `Deep` registers of rows by kColumns columns. Twelve independent sums keep two multipliers busy; with three
/// registers of w and one element of z they fill the sixteen registers of AVX2.
template <int Deep>
using Tile = Lanes[kColumns][Deep];

/// tile += w z^T; each element of w loaded serves four products. This function and the following ones are unrolled and
/// always inlined, since the sums must stay in registers.
template <int Deep>
[[gnu::always_inline]] inline void add(Tile<Deep>& t, const double* w, const double* z) {
  Lanes rows[Deep];
#pragma GCC unroll 3
  for (int i = 0; i < Deep; ++i) load(rows[i], w + i * kLanes);
#pragma GCC unroll 4
  for (int c = 0; c < kColumns; ++c) {
#pragma GCC unroll 3
    for (int i = 0; i < Deep; ++i) t[c][i] += rows[i] * z[c];
  }
}

template <int Deep>
[[gnu::always_inline]] inline void subtract(double* from, Index stride, const Tile<Deep>& t) {
#pragma GCC unroll 4
  for (int c = 0; c < kColumns; ++c, from += stride) {
#pragma GCC unroll 3
    for (int i = 0; i < Deep; ++i) {
      Lanes value;
      load(value, from + i * kLanes);
      store(from + i * kLanes, value - t[c][i]);
    }
  }
}

/// Reads and writes each element of the triangle once.
template <int Deep>
[[gnu::always_inline]] inline void update_tile(const LowerTriangle& A, const SymmetricProduct& product, Index row,
                                               Index column) {
  Tile<Deep> t{};
  double* a = A.data + column * A.stride + row;
#pragma GCC unroll 4
  for (Index c = 0; c < kColumns; ++c) {  // a hint only: the address may be beyond the matrix
#pragma GCC unroll 3
    for (Index r = 0; r < Deep * kLanes; r += kLine) __builtin_prefetch(a + c * A.stride + kAhead + r, 1);
  }
  const double* w = product.W + row;
  const double* z = product.W + column;
  for (Index k = 0; k < product.squares; ++k, w += product.stride, z += product.stride) add<Deep>(t, w, z);
  for (Index k = 0; k < product.pairs; ++k, w += 2 * product.stride, z += 2 * product.stride) {
    add<Deep>(t, w, z + product.stride);
    add<Deep>(t, w + product.stride, z);
  }
  subtract<Deep>(a, A.stride, t);
}

/// The tiles at `row` that reach below the diagonal, for the columns from `first` on. A separate function: inlined into
/// the caller's loops, the sums would lose their registers to the variables of those loops.
template <int Deep>
[[gnu::noinline]] void update_tiles(const LowerTriangle& A, const SymmetricProduct& product, Index row, Index first) {
  for (Index column = first; column < first + LowerTriangle::kTile && column < row + Deep * kLanes; column += kColumns)
    update_tile<Deep>(A, product, row, column);
}

/// Processes whole tiles only: those on the diagonal and at the lower edge reach into scratch. Several columns of tiles
/// are processed together, so that rows of W, once in the cache, are used more than once.
inline void update_triangle(const LowerTriangle& A, const SymmetricProduct& product) {
  for (Index first = 0; first < A.size; first += LowerTriangle::kTile) {
    Index row = first;
    for (; row + 2 * kLanes < A.size; row += kRows) update_tiles<kDeep>(A, product, row, first);
    if (row + kLanes < A.size)
      update_tiles<2>(A, product, row, first);
    else if (row < A.size)
      update_tiles<1>(A, product, row, first);
  }
}

/// Forward substitution on `Deep` registers of rows at once: these rows stay in the first-level cache for all their
/// columns, and each element of L loaded serves all of them.
template <int Deep>
inline void whiten_rows(double* W, Index stride, const double* L, Index L_stride, Index columns) {
  for (Index c = 0; c < columns; ++c) {
    double* const w = W + c * stride;
    Lanes rest[Deep];
#pragma GCC unroll 16
    for (int i = 0; i < Deep; ++i) load(rest[i], w + i * kLanes);
    const double* before = W;
    const double* factor = L + c;
    for (Index k = 0; k < c; ++k, before += stride, factor += L_stride) {
#pragma GCC unroll 16
      for (int i = 0; i < Deep; ++i) {
        Lanes value;
        load(value, before + i * kLanes);
        rest[i] -= *factor * value;
      }
    }
#pragma GCC unroll 16
    for (int i = 0; i < Deep; ++i) store(w + i * kLanes, rest[i] / L[c * L_stride + c]);
  }
}

template <int Deep>
inline Index whiten_rows_from(Index row, double* W, Index stride, Index size, const double* L, Index L_stride,
                              Index columns) {
  for (; row + Deep * kLanes <= LowerTriangle::padded(size); row += Deep * kLanes)
    whiten_rows<Deep>(W + row, stride, L, L_stride, columns);
  return row;
}

/// Eight registers form as many independent sums as two multipliers can work on.
inline void whiten_all_rows(double* W, Index stride, Index size, const double* L, Index L_stride, Index columns) {
  const Index row = whiten_rows_from<8>(0, W, stride, size, L, L_stride, columns);
  whiten_rows_from<LowerTriangle::kTile / kLanes>(row, W, stride, size, L, L_stride, columns);
}

}  // namespace
}  // namespace azimuth
