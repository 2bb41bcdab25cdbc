#pragma once
#include "slam/ekf/rank_update.hpp"

// The kernels of rank_update.hpp for processors with AVX2 and FMA.
namespace azimuth::avx2 {

void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product);
void whiten_columns(double* W, Eigen::Index stride, Eigen::Index size, const double* L, Eigen::Index L_stride,
                    Eigen::Index columns);

}  // namespace azimuth::avx2
