#pragma once
#include "slam/ekf/column_sum.hpp"

// The kernel of column_sum.hpp for processors with AVX2.
namespace azimuth::avx2 {

void add_columns(const ScaledColumns* parts, Eigen::Index count, Eigen::Index size, double* out);

}  // namespace azimuth::avx2
