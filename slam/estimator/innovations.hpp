#pragma once
#include <cstddef>
#include <span>

#include "slam/estimator/estimate.hpp"
#include "slam/sample/expected_bearing.hpp"

namespace azimuth {

/// Innovations of the azimuths that corrected a step, normalised by their expected standard deviations.
struct Innovations {
  double nis = 0.0;  ///< Sum of the normalised squared innovations; a consistent estimator's grows by 1 per azimuth
  std::size_t compared = 0;
};

/// Compares the accepted azimuths whose landmark has an expected bearing. `expected` must be sorted by landmark id.
/// Reentrant.
Innovations innovations_of(std::span<const ExpectedBearing> expected, std::span<const AcceptedSighting> accepted);

}  // namespace azimuth
