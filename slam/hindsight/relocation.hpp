#pragma once
#include <optional>
#include <span>

#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// The pose from one image of named landmarks, where most of it contradicts the pose that is believed and one other
/// explains it: wheels that slipped are found out at once. Nothing: the image is as good as usual, or shows too little.
///
/// `belief` is the pose and its covariance of (x [m], y [m], heading [rad]) in the map. Thread contract: reentrant.
std::optional<PoseGaussian> relocated(const Mapper& mapper, const PoseGaussian& belief, double min_distance_m);

}  // namespace azimuth
