// Compiled with -mavx2 (CMakeLists.txt); called only on processors with AVX2.

#include "slam/perception/image/resample_loops.hpp"

namespace azimuth::avx2 {

void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums) {
  add_weighted_lanes(values, weight, count, sums);
}

}  // namespace azimuth::avx2
