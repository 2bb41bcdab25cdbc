// The hot loops of the EKF: at 500 landmarks they touch half a million elements per step. They are compiled for three
// kinds of processor and chosen at run time, since robots carry old computers too.

#include "slam/ekf/rank_update.hpp"

#include "slam/ekf/rank_update_tile.hpp"

namespace azimuth {
namespace {

struct Kernels {
  decltype(&subtract_symmetric_product) subtract;
  decltype(&whiten_columns) whiten;
};

Kernels best_for_this_processor() {
#if defined(__x86_64__)
  const bool has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  if (has_avx2 && __builtin_cpu_supports("avx512f") != 0)
    return {avx512::subtract_symmetric_product, avx512::whiten_columns};
  if (has_avx2) return {avx2::subtract_symmetric_product, avx2::whiten_columns};
#endif
  return {[](LowerTriangle A, SymmetricProduct product) { update_triangle(A, product); },
          [](double* W, Index stride, Index size, const double* L, Index L_stride, Index columns) {
            whiten_all_rows(W, stride, size, L, L_stride, columns);
          }};
}

const Kernels& kernels() {
  static const Kernels chosen = best_for_this_processor();
  return chosen;
}

}  // namespace

void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product) {
  if (product.squares > 0 || product.pairs > 0) kernels().subtract(A, product);
}

void whiten_columns(double* W, Index stride, Index size, const double* L, Index L_stride, Index columns) {
  kernels().whiten(W, stride, size, L, L_stride, columns);
}

}  // namespace azimuth
