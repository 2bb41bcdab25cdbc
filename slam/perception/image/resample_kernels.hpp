#pragma once
#include <cstdint>

namespace azimuth {

/// sums[i] += weight * values[i] for `count` of them, rounded up to a multiple of kResampleLanes: that many may be read
/// and written. Does not overflow as long as the weights that went into a sum add up to at most 256.
///
/// The same on every processor. Thread contract: reentrant.
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums);
inline constexpr int kResampleLanes = 16;

namespace avx2 {
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums);
}
namespace portable {
void add_weighted(const std::uint8_t* values, int weight, int count, std::uint16_t* sums);
}

}  // namespace azimuth
