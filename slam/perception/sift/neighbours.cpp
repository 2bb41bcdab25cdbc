#include "slam/perception/sift/neighbours.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace azimuth {
namespace {

Neighbours nearest_to(std::size_t place, std::span<const KeyPoint> key_points) {
  Neighbours nearest;
  std::array<float, Neighbours::kMost> distance_px;
  distance_px.fill(std::numeric_limits<float>::infinity());
  for (std::size_t other = 0; other < key_points.size(); ++other) {
    if (other == place) continue;
    const float away_px = std::abs(key_points[other].x_px - key_points[place].x_px) +
                          std::abs(key_points[other].y_px - key_points[place].y_px);
    if (!(away_px < distance_px.back())) continue;
    std::size_t rank = Neighbours::kMost - 1;
    for (; rank > 0 && away_px < distance_px[rank - 1]; --rank) {
      distance_px[rank] = distance_px[rank - 1];
      nearest.index[rank] = nearest.index[rank - 1];
    }
    distance_px[rank] = away_px;
    nearest.index[rank] = static_cast<std::uint16_t>(other);
  }
  return nearest;
}

}  // namespace

void find_neighbours(std::span<const KeyPoint> key_points, std::vector<Neighbours>& out) {
  out.clear();
  for (std::size_t i = 0; i < key_points.size(); ++i) out.push_back(nearest_to(i, key_points));
}

}  // namespace azimuth
