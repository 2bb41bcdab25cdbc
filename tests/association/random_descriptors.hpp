#pragma once
#include <algorithm>
#include <cmath>

#include "slam/sample/bearings.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {

/// A descriptor with values over the whole range of a byte. Its sums are larger than those of real descriptors.
inline Descriptor random_descriptor(RandomDraws& draws) {
  Descriptor descriptor;
  for (std::uint8_t& value : descriptor.values) value = static_cast<std::uint8_t>(draws.integer(0, 255));
  return descriptor;
}

/// The same descriptor with normal noise added to each value.
inline Descriptor seen_again(const Descriptor& descriptor, double sigma, RandomDraws& draws) {
  Descriptor again;
  for (std::size_t i = 0; i < again.values.size(); ++i) {
    const double value = descriptor.values[i] + sigma * draws.normal();
    again.values[i] = static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0));
  }
  return again;
}

inline std::int32_t squared_distance(const Descriptor& a, const Descriptor& b) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const std::int32_t difference = a.values[i] - b.values[i];
    sum += difference * difference;
  }
  return sum;
}

}  // namespace azimuth
