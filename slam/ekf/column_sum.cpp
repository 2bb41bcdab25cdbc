#include "slam/ekf/column_sum.hpp"

#include "slam/ekf/column_sum_loops.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

void add_columns(std::span<const ScaledColumns> parts, Eigen::Index size, double* out) {
  const auto count = as_index(parts.size());
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return avx2::add_columns(parts.data(), count, size, out);
#endif
  add_all_columns(parts.data(), count, size, out);
}

}  // namespace azimuth
