#pragma once
// The loops of rank_update.hpp, included once for each instruction set they are compiled for, with kLanes doubles to a
// register. Everything here has internal linkage and uses nothing of the standard library, so that no code for one
// processor can be linked into another's.

#include "slam/ekf/rank_update.hpp"

#ifndef AZIMUTH_LANES
#define AZIMUTH_LANES 2
#endif

namespace azimuth {
namespace {

using Index = Eigen::Index;
// NOLINTBEGIN(misc-definitions-in-headers): a copy for each instruction set is the point
constexpr Index kLanes = AZIMUTH_LANES;
constexpr Index kRows = 2 * kLanes, kColumns = 4;            // of a tile
constexpr Index kRegisters = LowerTriangle::kTile / kLanes;  // of one column of as many rows as are readable
using Lanes = double __attribute__((vector_size(8 * kLanes)));
using LanesAnywhere [[gnu::aligned(8), gnu::may_alias]] = Lanes;  // in memory
// Memory is asked for the elements so many rows further down before this tile is computed: a triangle of 1000 landmarks
// is twice as fast with it.
constexpr Index kAhead = 3 * kRows;
// NOLINTEND(misc-definitions-in-headers)
static_assert(LowerTriangle::kTile % kRows == 0 && LowerTriangle::kTile % kColumns == 0);

// Written out and not as loops: the sums must live in registers at any level of optimisation.
struct Tile {
  Lanes a0{}, a1{}, a2{}, a3{};  // the first kLanes rows of four columns
  Lanes b0{}, b1{}, b2{}, b3{};  // the next kLanes rows
};

// Not memcpy: for arm64 GCC takes that through the stack.
inline void load(Lanes& value, const double* from) { value = *reinterpret_cast<const LanesAnywhere*>(from); }

inline void store(double* to, const Lanes& value) { *reinterpret_cast<LanesAnywhere*>(to) = value; }

inline void subtract(double* from, const Lanes& low, const Lanes& high) {
  Lanes a, b;
  load(a, from);
  load(b, from + kLanes);
  store(from, a - low);
  store(from + kLanes, b - high);
}

/// tile += w z^T; each element of w loaded serves four products.
inline void add(Tile& t, const double* w, const double* z) {
  Lanes low, high;
  load(low, w);
  load(high, w + kLanes);
  t.a0 += low * z[0];
  t.b0 += high * z[0];
  t.a1 += low * z[1];
  t.b1 += high * z[1];
  t.a2 += low * z[2];
  t.b2 += high * z[2];
  t.a3 += low * z[3];
  t.b3 += high * z[3];
}

/// Each element of the triangle is read and written once.
inline void update_tile(const LowerTriangle& A, const SymmetricProduct& product, Index row, Index column) {
  Tile t;
  double* a = A.data + column * A.stride + row;
  for (Index c = 0; c < kColumns; ++c) {  // a hint only: it may point beyond the matrix
    __builtin_prefetch(a + c * A.stride + kAhead, 1);
    __builtin_prefetch(a + c * A.stride + kAhead + kLanes, 1);
  }
  const double* w = product.W + row;
  const double* z = product.W + column;
  for (Index k = 0; k < product.squares; ++k, w += product.stride, z += product.stride) add(t, w, z);
  for (Index k = 0; k < product.pairs; ++k, w += 2 * product.stride, z += 2 * product.stride) {
    add(t, w, z + product.stride);
    add(t, w + product.stride, z);
  }
  subtract(a, t.a0, t.b0);
  subtract(a + A.stride, t.a1, t.b1);
  subtract(a + 2 * A.stride, t.a2, t.b2);
  subtract(a + 3 * A.stride, t.a3, t.b3);
}

/// Whole tiles only: those on the diagonal and at the lower edge reach beyond the triangle, into scratch. Several
/// columns of tiles go down together, so that rows of W fetched from afar are used more than once.
inline void update_triangle(const LowerTriangle& A, const SymmetricProduct& product) {
  for (Index first = 0; first < A.size; first += LowerTriangle::kTile)
    for (Index row = first; row < A.size; row += kRows)
      for (Index column = first; column < first + LowerTriangle::kTile; column += kColumns)
        update_tile(A, product, row, column);
}

/// Forward substitution on LowerTriangle::kTile rows at once: they stay in the nearest cache while all their columns
/// are worked on, and each element of L loaded serves them all.
inline void whiten_rows(double* W, Index stride, Index size, const double* L, Index L_stride, Index columns) {
  for (Index row = 0; row < size; row += LowerTriangle::kTile)
    for (Index c = 0; c < columns; ++c) {
      double* const w = W + c * stride + row;
      Lanes rest[kRegisters];
#pragma GCC unroll 8
      for (Index i = 0; i < kRegisters; ++i) load(rest[i], w + i * kLanes);
      const double* before = W + row;
      const double* factor = L + c;
      for (Index k = 0; k < c; ++k, before += stride, factor += L_stride) {
#pragma GCC unroll 8
        for (Index i = 0; i < kRegisters; ++i) {
          Lanes value;
          load(value, before + i * kLanes);
          rest[i] -= *factor * value;
        }
      }
#pragma GCC unroll 8
      for (Index i = 0; i < kRegisters; ++i) store(w + i * kLanes, rest[i] / L[c * L_stride + c]);
    }
}

}  // namespace
}  // namespace azimuth
