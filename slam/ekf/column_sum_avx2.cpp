// Compiled with -mavx2 (CMakeLists.txt) and without FMA, which would round differently. Called only on processors with
// AVX2.

#include "slam/ekf/column_sum.hpp"

#define AZIMUTH_LANES 4
#include "slam/ekf/column_sum_loops.hpp"

namespace azimuth::avx2 {

void add_columns(const ScaledColumns* parts, Eigen::Index count, Eigen::Index size, double* out) {
  add_all_columns(parts, count, size, out);
}

}  // namespace azimuth::avx2
