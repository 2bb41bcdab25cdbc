#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The bearings that the estimator expected in an image, before it used the bearings detected there.
struct ExpectedImage {
  std::optional<Stamp> stamp;  ///< stamp of the image; none: no image yet
  std::vector<ExpectedBearing> bearings;
  std::vector<std::int64_t> in_map;  ///< identifiers of the landmarks in the map, ascending; for pictures
};

}  // namespace azimuth
