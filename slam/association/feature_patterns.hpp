#pragma once
// Feature patterns (mathematics I.14): compares the neighbours of one feature with those of another.

#include <array>
#include <cstddef>
#include <span>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Pearson's correlation of two equally long sequences, in [-1, 1]; 0 when one of them is constant.
double correlation(std::span<const double> a, std::span<const double> b);

/// Pearson's correlation of the values of two descriptors.
double correlation(const Descriptor& a, const Descriptor& b);

/// The descriptors of a feature's neighbours.
struct Pattern {
  std::array<Descriptor, Neighbours::kMost> members{};
  std::size_t count = 0;

  std::span<const Descriptor> seen() const { return {members.data(), count}; }
};

/// The pattern of feature `at` in its image. Neighbours without a descriptor are left out.
Pattern pattern_of(const BearingSet& image, std::size_t at);

/// The number of members of `first` that correlate by more than `threshold` with some member of `second`; one member of
/// `second` may match several.
template <class Members>
std::size_t matched_members(const Members& first, const Members& second, double threshold) {
  std::size_t matched = 0;
  for (const auto& a : first) {
    bool found = false;
    for (const auto& b : second) found = found || correlation(a, b) > threshold;
    matched += found ? 1 : 0;
  }
  return matched;
}

}  // namespace azimuth
