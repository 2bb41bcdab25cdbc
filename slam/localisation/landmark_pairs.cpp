#include "slam/localisation/landmark_pairs.hpp"

#include <algorithm>
#include <tuple>

namespace azimuth {

void LandmarkPairs::build(std::span<const KnownLandmark> landmarks, double longest_m) {
  pairs_.clear();
  for (std::size_t a = 0; a < landmarks.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!landmarks[a].has_height() || !landmarks[b].has_height()) continue;
      const double distance_m = (landmarks[a].p_map_m - landmarks[b].p_map_m).head<2>().norm();
      if (distance_m <= longest_m)
        pairs_.push_back({distance_m, static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b)});
    }
  std::ranges::sort(pairs_, [](const Pair& x, const Pair& y) {
    return std::tie(x.distance_m, x.a, x.b) < std::tie(y.distance_m, y.a, y.b);
  });
}

std::span<const LandmarkPairs::Pair> LandmarkPairs::between(double shortest_m, double longest_m) const {
  const auto first = std::ranges::lower_bound(pairs_, shortest_m, std::less{}, &Pair::distance_m);
  const auto last = std::ranges::upper_bound(pairs_, longest_m, std::less{}, &Pair::distance_m);
  return first < last ? std::span<const Pair>(first, last) : std::span<const Pair>();
}

}  // namespace azimuth
