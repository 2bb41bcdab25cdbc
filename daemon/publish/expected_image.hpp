#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/sample/expected_bearing.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// What the estimator expected of an image, before it used the bearings found in it.
struct ExpectedImage {
  std::optional<Stamp> stamp;  ///< of the image; none: of none yet
  std::vector<ExpectedBearing> bearings;
  std::vector<std::int64_t> in_map;  ///< ids of the map's landmarks, rising: for pictures
};

}  // namespace azimuth
