#include "slam/perception/sift/scale_space_kernels.hpp"

#include "slam/perception/sift/scale_space_loops.hpp"

namespace azimuth {

const ScaleSpaceKernels& portable_scale_space_kernels() { return kernels(); }

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

const ScaleSpaceKernels& scale_space_kernels() {
  static const ScaleSpaceKernels& chosen = has_avx2() ? avx2_scale_space_kernels() : portable_scale_space_kernels();
  return chosen;
}

}  // namespace azimuth
