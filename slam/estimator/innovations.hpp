#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "slam/estimator/estimate.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Innovations of the azimuths that corrected a step, normalised by their expected standard deviations.
struct Innovations {
  double nis = 0.0;  ///< Sum of the normalised squared innovations; a consistent estimator's grows by 1 per azimuth
  std::size_t compared = 0;
};

/// Compares the accepted azimuths whose landmark has an expected bearing. `expected` must be sorted by landmark id.
/// Reentrant.
inline Innovations innovations_of(std::span<const ExpectedBearing> expected,
                                  std::span<const AcceptedSighting> accepted) {
  Innovations sum;
  for (const AcceptedSighting& sighting : accepted) {
    const auto found = std::ranges::lower_bound(expected, sighting.landmark_id, {}, &ExpectedBearing::landmark);
    if (found == expected.end() || found->landmark != sighting.landmark_id) continue;
    const double deviation = wrap(sighting.azimuth_rad - found->azimuth_rad) / found->sigma_rad;
    if (!std::isfinite(deviation)) continue;
    ++sum.compared;
    sum.nis += deviation * deviation;
  }
  return sum;
}

}  // namespace azimuth
