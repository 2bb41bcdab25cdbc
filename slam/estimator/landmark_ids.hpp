#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "slam/estimator/estimate.hpp"

namespace azimuth {

/// Of an estimate's landmarks, rising, into storage that is reused. For people landmarks are counted in this order, so
/// that a map of two dozen has no numbers of three digits.
inline void ids_of(const std::vector<LandmarkEstimate>& landmarks, std::vector<std::int64_t>& out) {
  out.clear();
  for (const LandmarkEstimate& landmark : landmarks) out.push_back(landmark.id);
  std::ranges::sort(out);
}

}  // namespace azimuth
