#pragma once
#include <vector>

#include "slam/perception/calibration/ring_profile.hpp"

namespace azimuth {

/// Rings that may be the rim of a mirror, the likeliest first, at most `most` and well apart: every centre in the inner
/// part of the map and every radius from a tenth of its longer side is looked at.
std::vector<ImageCircle> likely_rims(const EdgeMap& map, std::size_t most);

/// The ring of the best rim_score() near `start`: centre within `span`, radius within twice that, then finer.
ImageCircle best_rim_near(const EdgeMap& map, const ImageCircle& start, double span);

/// The disc in the middle of a mirror in which camera and robot see themselves: within half of the rim and nearly about
/// its centre, the strongest edge all round with less detail inside than outside. Radius 0: there is none.
ImageCircle inner_disc(const EdgeMap& map, const ImageCircle& rim);

}  // namespace azimuth
