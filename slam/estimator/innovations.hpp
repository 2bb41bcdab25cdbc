#pragma once
#include <cstddef>
#include <span>

#include "slam/estimator/estimate.hpp"
#include "slam/sample/expected_bearing.hpp"

namespace azimuth {

/// How far off the azimuths were that corrected a step, in standard deviations of what was expected of them.
struct Innovations {
  double nis = 0.0;  ///< normalised innovation squared, summed up: an honest estimator's grows by 1 with each of them
  std::size_t compared = 0;
};

/// Of those of whose landmark anything was expected. `expected` in the order of their landmarks. Reentrant.
Innovations innovations_of(std::span<const ExpectedBearing> expected, std::span<const AcceptedSighting> accepted);

}  // namespace azimuth
