#include "slam/perception/image/resample_kernels.hpp"

#include "slam/perception/image/resample_loops.hpp"

namespace azimuth {

void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums) {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return avx2::add_weighted(values, weight, count, sums);
#endif
  portable::add_weighted(values, weight, count, sums);
}

namespace portable {
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums) {
  add_weighted_lanes(values, weight, count, sums);
}
}  // namespace portable

}  // namespace azimuth
