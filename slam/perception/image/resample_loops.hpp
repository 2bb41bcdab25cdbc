#pragma once
// The loop of resample_kernels.hpp, included once for each instruction set that it is compiled for. All names have
// internal linkage, and no code calls the standard library, so the linker cannot merge code for different processors.

#include "slam/perception/image/resample_kernels.hpp"

namespace azimuth {
namespace {

using Bytes = std::uint8_t __attribute__((vector_size(kResampleLanes)));
using Words = std::uint16_t __attribute__((vector_size(2 * kResampleLanes)));

inline void add_weighted_lanes(const std::uint8_t* values, int weight, int count, std::uint16_t* sums) {
  const auto factor = static_cast<std::uint16_t>(weight);
  for (int i = 0; i < count; i += kResampleLanes) {
    Bytes bytes;
    Words sum;
    __builtin_memcpy(&bytes, values + i, sizeof bytes);
    __builtin_memcpy(&sum, sums + i, sizeof sum);
    sum += __builtin_convertvector(bytes, Words) * factor;
    __builtin_memcpy(sums + i, &sum, sizeof sum);
  }
}

}  // namespace
}  // namespace azimuth
