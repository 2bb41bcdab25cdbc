#pragma once
#include <cstddef>
#include <vector>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// A possible pair of bearing and landmark, and its cost.
struct CostlyPair {
  double cost = 0.0;
  BearingId bearing = 0;
  LandmarkId landmark = kOfNothing;
};

struct ClearPairsSettings {
  double alone = 0.0;      ///< cost of an unassociated bearing
  double dearest = 0.0;    ///< maximum cost of an accepted pair
  double rival_gap = 0.0;  ///< minimum extra cost of every alternative to a pair
};

/// Returns the landmark, or kOfNothing, for each of the `bearings` bearings of one image, from `first` on. Pairs are
/// chosen one to one, cheapest first. A chosen pair is clear when every alternative use of its bearing or landmark
/// costs more by `rival_gap`, including the effect on the pair that the alternative breaks up. Unclear pairs are left
/// out. Pairs that cost up to `dearest + rival_gap` count as rivals. Thread contract: reentrant.
std::vector<LandmarkId> clear_pairs(std::vector<CostlyPair> pairs, BearingId first, std::size_t bearings,
                                    const ClearPairsSettings& settings);

}  // namespace azimuth
