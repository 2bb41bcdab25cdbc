#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// Relocalisation from one image with identities, for instance after the wheels have slipped. Returns a pose when most
/// of the image contradicts the believed pose and exactly one other pose explains it; otherwise empty.
///
/// Only landmarks with ids below `known_below` are used. `belief` is the pose and its covariance of (x [m], y [m],
/// heading [rad]) in the map. Thread contract: reentrant.
std::optional<PoseGaussian> relocated(const Mapper& mapper, const PoseGaussian& belief, std::int64_t known_below,
                                      double min_distance_m);

}  // namespace azimuth
