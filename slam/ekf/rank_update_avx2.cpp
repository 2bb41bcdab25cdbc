// Compiled with -mavx2 -mfma (CMakeLists.txt); reached only where the processor has both.

#include "slam/ekf/rank_update_avx2.hpp"

#include "slam/ekf/rank_update_tile.hpp"

namespace azimuth {

void subtract_symmetric_product_avx2(LowerTriangle A, const double* W, const double* Z, Eigen::Index stride,
                                     Eigen::Index columns) {
  update_triangle(A, W, Z, stride, columns);
}

}  // namespace azimuth
