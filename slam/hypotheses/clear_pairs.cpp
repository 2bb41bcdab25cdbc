#include "slam/hypotheses/clear_pairs.hpp"

#include <algorithm>
#include <tuple>

namespace azimuth {

std::vector<LandmarkId> clear_pairs(std::vector<CostlyPair> pairs, BearingId first, std::size_t bearings,
                                    const ClearPairsSettings& settings) {
  std::sort(pairs.begin(), pairs.end(), [](const CostlyPair& a, const CostlyPair& b) {
    return std::tie(a.cost, a.bearing, a.landmark) < std::tie(b.cost, b.bearing, b.landmark);
  });
  const auto index = [first](BearingId bearing) { return static_cast<std::size_t>(bearing - first); };
  std::vector<const CostlyPair*> of_bearing(bearings, nullptr);
  const auto pair_with = [&](LandmarkId landmark) -> const CostlyPair* {
    for (const CostlyPair* pair : of_bearing)
      if (pair != nullptr && pair->landmark == landmark) return pair;
    return nullptr;
  };
  for (const CostlyPair& pair : pairs) {
    if (pair.cost > settings.dearest) break;
    if (of_bearing[index(pair.bearing)] == nullptr && pair_with(pair.landmark) == nullptr)
      of_bearing[index(pair.bearing)] = &pair;
  }
  const auto cost_of = [&](BearingId bearing, LandmarkId landmark) {
    for (const CostlyPair& pair : pairs)
      if (pair.bearing == bearing && pair.landmark == landmark) return std::min(pair.cost, settings.alone);
    return settings.alone;
  };
  std::vector<LandmarkId> chosen(bearings, kOfNothing);
  for (const CostlyPair* pair : of_bearing) {
    if (pair == nullptr) continue;
    const bool has_rival = std::any_of(pairs.begin(), pairs.end(), [&](const CostlyPair& other) {
      if ((other.bearing == pair->bearing) == (other.landmark == pair->landmark)) return false;
      double instead = other.cost, now = pair->cost;
      if (other.bearing == pair->bearing) {
        if (const CostlyPair* robbed = pair_with(other.landmark)) {
          now += robbed->cost;
          instead += cost_of(robbed->bearing, pair->landmark);
        }
      } else {
        const CostlyPair* robbed = of_bearing[index(other.bearing)];
        now += robbed != nullptr ? robbed->cost : settings.alone;
        instead += robbed != nullptr ? cost_of(pair->bearing, robbed->landmark) : settings.alone;
      }
      return instead < now + settings.rival_gap;
    });
    if (!has_rival) chosen[index(pair->bearing)] = pair->landmark;
  }
  return chosen;
}

}  // namespace azimuth
