#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "slam/estimator/estimate.hpp"

namespace azimuth {

/// Writes the ids of an estimate's landmarks, ascending, into `out`, reusing its storage. User output numbers landmarks
/// by their place in this order, so that a map of two dozen landmarks has no three-digit numbers.
inline void ids_of(const std::vector<LandmarkEstimate>& landmarks, std::vector<std::int64_t>& out) {
  out.clear();
  for (const LandmarkEstimate& landmark : landmarks) out.push_back(landmark.id);
  std::ranges::sort(out);
}

}  // namespace azimuth
