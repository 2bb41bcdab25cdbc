#include "slam/estimator/innovations.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

Innovations innovations_of(std::span<const ExpectedBearing> expected, std::span<const AcceptedSighting> accepted) {
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
