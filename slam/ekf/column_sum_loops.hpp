#pragma once
// The loops of column_sum.hpp (see lanes.hpp).

#include "slam/ekf/column_sum.hpp"
#include "slam/ekf/lanes.hpp"

namespace azimuth {
namespace {

/// Rows `row` to row + Deep * kLanes - 1.
template <int Deep>
[[gnu::always_inline]] inline void add_columns_to_rows(const ScaledColumns* parts, Index count, Index row,
                                                       double* out) {
  Lanes sum[Deep];
#pragma GCC unroll 4
  for (int i = 0; i < Deep; ++i) load(sum[i], out + row + i * kLanes);
  for (const ScaledColumns* part = parts; part != parts + count; ++part) {
    Lanes of_part[Deep];
    const double* column = part->first + row;
#pragma GCC unroll 4
    for (int i = 0; i < Deep; ++i) {
      load(of_part[i], column + i * kLanes);
      of_part[i] *= part->factors[0];
    }
    for (Index s = 1; s < part->count; ++s) {
      column += part->stride;
#pragma GCC unroll 4
      for (int i = 0; i < Deep; ++i) {
        Lanes value;
        load(value, column + i * kLanes);
        of_part[i] += value * part->factors[s];
      }
    }
#pragma GCC unroll 4
    for (int i = 0; i < Deep; ++i) sum[i] += of_part[i];
  }
#pragma GCC unroll 4
  for (int i = 0; i < Deep; ++i) store(out + row + i * kLanes, sum[i]);
}

inline void add_columns_to_row(const ScaledColumns* parts, Index count, Index row, double* out) {
  for (const ScaledColumns* part = parts; part != parts + count; ++part) {
    double of_part = part->factors[0] * part->first[row];
    for (Index s = 1; s < part->count; ++s) of_part += part->factors[s] * part->first[s * part->stride + row];
    out[row] += of_part;
  }
}

inline void add_all_columns(const ScaledColumns* parts, Index count, Index size, double* out) {
  Index row = 0;
  for (; row + 4 * kLanes <= size; row += 4 * kLanes) add_columns_to_rows<4>(parts, count, row, out);
  for (; row + kLanes <= size; row += kLanes) add_columns_to_rows<1>(parts, count, row, out);
  for (; row < size; ++row) add_columns_to_row(parts, count, row, out);
}

}  // namespace
}  // namespace azimuth
