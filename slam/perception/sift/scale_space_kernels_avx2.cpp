// Compiled with -mavx2 (CMakeLists.txt); called only on processors with AVX2.

#include "slam/perception/sift/scale_space_loops.hpp"

namespace azimuth {

const ScaleSpaceKernels& avx2_scale_space_kernels() { return kernels(); }

}  // namespace azimuth
