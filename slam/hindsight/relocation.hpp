#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// The pose from one image of named landmarks, where most of it contradicts the pose that is believed and one other
/// explains it: wheels that slipped are found out at once. Nothing: the image is as good as usual, or shows too little.
///
/// Landmarks of ids below `known_below` are gone by only. `belief` is the pose and its covariance of (x [m], y [m],
/// heading [rad]) in the map. Thread contract: reentrant.
std::optional<PoseGaussian> relocated(const Mapper& mapper, const PoseGaussian& belief, std::int64_t known_below,
                                      double min_distance_m);

}  // namespace azimuth
