#pragma once
#include "slam/ekf/rank_update.hpp"

namespace azimuth {

/// As subtract_symmetric_product(), for processors with AVX2 and FMA only.
void subtract_symmetric_product_avx2(LowerTriangle A, const double* W, const double* Z, Eigen::Index stride,
                                     Eigen::Index columns);

}  // namespace azimuth
