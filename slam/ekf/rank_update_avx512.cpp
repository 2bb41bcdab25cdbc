// Compiled with -mavx512f (CMakeLists.txt). Called only on processors with AVX-512F.

#include "slam/ekf/rank_update.hpp"

#define AZIMUTH_LANES 8
#include "slam/ekf/rank_update_tile.hpp"

namespace azimuth::avx512 {

void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product) { update_triangle(A, product); }

void whiten_columns(double* W, Eigen::Index stride, Eigen::Index size, const double* L, Eigen::Index L_stride,
                    Eigen::Index columns) {
  whiten_all_rows(W, stride, size, L, L_stride, columns);
}

}  // namespace azimuth::avx512
