#pragma once
#include <cstdint>

namespace azimuth {

/// sums[i] += weight * values[i] for `count` values, where `count` is rounded up to a multiple of kResampleLanes: so
/// many values may be read and written. A sum does not overflow as long as its weights add up to at most 256.
///
/// The result is the same on every processor. Thread contract: reentrant.
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums);
inline constexpr int kResampleLanes = 16;

namespace avx2 {
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums);
}
namespace portable {
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums);
}

}  // namespace azimuth
