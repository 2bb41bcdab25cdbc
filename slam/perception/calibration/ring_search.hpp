#pragma once
#include <vector>

#include "slam/perception/calibration/ring_profile.hpp"

namespace azimuth {

/// Returns rings that may be the rim of a mirror, the best first, at most `most` and well apart. The search covers all
/// centres in the inner part of the map and all radii from a tenth of the map's longer side.
std::vector<ImageCircle> likely_rims(const EdgeMap& map, std::size_t most);

/// Returns the ring with the best rim_score() near `start`. The centre is searched within `span` and the radius within
/// twice `span`, first coarsely, then finely.
ImageCircle best_rim_near(const EdgeMap& map, const ImageCircle& start, double span);

/// Finds the disc in the middle of a mirror in which camera and robot see themselves: the strongest closed edge within
/// half of the rim's radius and nearly concentric with the rim, with less detail inside than outside. Radius 0 if there
/// is none.
ImageCircle inner_disc(const EdgeMap& map, const ImageCircle& rim);

}  // namespace azimuth
