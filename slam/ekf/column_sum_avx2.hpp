#pragma once
#include "slam/ekf/column_sum.hpp"

// As in column_sum.hpp, for processors with AVX2 only.
namespace azimuth::avx2 {

void add_columns(const ScaledColumns* parts, Eigen::Index count, Eigen::Index size, double* out);

}  // namespace azimuth::avx2
