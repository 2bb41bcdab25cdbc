#pragma once
#include <cstddef>
#include <vector>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// That a bearing is of a landmark, and what that costs.
struct CostlyPair {
  double cost = 0.0;
  BearingId bearing = 0;
  LandmarkId landmark = kOfNothing;
};

struct ClearPairsSettings {
  double alone = 0.0;      ///< what a bearing of nothing costs
  double dearest = 0.0;    ///< no pair that costs more
  double rival_gap = 0.0;  ///< by which other ways to give away what a pair has must be dearer
};

/// For each of the `bearings` bearings of one image, from `first` on, its landmark, or kOfNothing. Cheapest first, one
/// to one. A pair is clear when every other way to give away its bearing or its landmark costs more by the gap, what
/// that does to the pair it is taken from included; what is not clear is left out. Pairs between the dearest and that
/// plus the gap count as rivals. Thread contract: reentrant.
std::vector<LandmarkId> clear_pairs(std::vector<CostlyPair> pairs, BearingId first, std::size_t bearings,
                                    const ClearPairsSettings& settings);

}  // namespace azimuth
