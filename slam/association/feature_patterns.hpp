#pragma once
// Feature patterns (SPEC I.14): the features around a feature, compared with those around another.

#include <array>
#include <cstddef>
#include <span>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Pearson's correlation of two equally long sequences, in [-1, 1]; 0 when one of them is constant.
double correlation(std::span<const double> a, std::span<const double> b);

/// Likewise of two descriptors' values.
double correlation(const Descriptor& a, const Descriptor& b);

/// The neighbours of a feature, by their looks.
struct Pattern {
  std::array<Descriptor, Neighbours::kMost> members{};
  std::size_t count = 0;

  std::span<const Descriptor> seen() const { return {members.data(), count}; }
};

/// Of feature `at` in its image; descriptors of neighbours that are not there are left out.
Pattern pattern_of(const BearingSet& image, std::size_t at);

/// How many members of `first` correlate by more than `threshold` with some member of `second`; one of the second may
/// serve several.
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
