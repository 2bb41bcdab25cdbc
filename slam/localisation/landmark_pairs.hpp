#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/localisation/known_map.hpp"

namespace azimuth {

/// All pairs of landmarks of known height, sorted by their distance in the plane.
///
/// Thread contract: thread-bound.
class LandmarkPairs {
 public:
  struct Pair {
    double distance_m;
    std::uint16_t a, b;  ///< Indices of the landmarks
  };

  /// Leaves out pairs farther apart than `longest_m`, which cannot be seen together.
  void build(std::span<const KnownLandmark> landmarks, double longest_m);

  /// The pairs whose distance is in this range.
  std::span<const Pair> between(double shortest_m, double longest_m) const;
  bool empty() const { return pairs_.empty(); }

 private:
  std::vector<Pair> pairs_;
};

}  // namespace azimuth
