// The hot loop of the EKF: at 500 landmarks it touches half a million elements a step. It is compiled twice, for the
// baseline and for AVX2 with fused multiply-add, and chosen at run time: robots carry old computers.

#include "slam/ekf/rank_update.hpp"

#include "slam/ekf/rank_update_avx2.hpp"
#include "slam/ekf/rank_update_tile.hpp"

namespace azimuth {

void subtract_symmetric_product(LowerTriangle A, const double* W, const double* Z, Eigen::Index stride,
                                Eigen::Index columns) {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  if (has_avx2) return subtract_symmetric_product_avx2(A, W, Z, stride, columns);
#endif
  update_triangle(A, W, Z, stride, columns);
}

}  // namespace azimuth
