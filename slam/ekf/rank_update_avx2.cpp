// Compiled with -mavx2 -mfma (CMakeLists.txt). Called only on processors with both.

#include "slam/ekf/rank_update.hpp"

#define AZIMUTH_LANES 4
#include "slam/ekf/rank_update_tile.hpp"

namespace azimuth::avx2 {

void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product) { update_triangle(A, product); }

void whiten_columns(double* W, Eigen::Index stride, Eigen::Index size, const double* L, Eigen::Index L_stride,
                    Eigen::Index columns) {
  whiten_all_rows(W, stride, size, L, L_stride, columns);
}

}  // namespace azimuth::avx2
