#pragma once
// Matches the features of two images by the method of mathematics I.12 and counts the results.

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth::test {

inline int squared_distance(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const int off = int{a.values[i]} - int{b.values[i]};
    sum += off * off;
  }
  return sum;
}

/// Features detected in one image.
struct SeenFeatures {
  BearingSet set;
  std::vector<KeyPoint> key_points;
};

inline SeenFeatures seen(SiftPerception& perception, const ImageView& image) {
  SeenFeatures features;
  perception.observe(image, features.set);
  features.key_points = perception.key_points();
  return features;
}

struct MatchCount {
  int features = 0;  ///< in the first image
  int matched = 0;   ///< distance to the nearest descriptor is less than `ratio` times that to the second nearest
  int right = 0;     ///< matched features of the same object
  double right_share() const { return 1.0 * right / std::max(1, features); }
};

/// `same_thing(i, j)`: whether feature i of the first image and feature j of the second are the same.
template <class SameThing>
MatchCount count_matches(const SeenFeatures& first, const SeenFeatures& second, double ratio,
                         const SameThing& same_thing) {
  MatchCount count;
  for (std::size_t i = 0; i < first.key_points.size(); ++i) {
    int nearest = std::numeric_limits<int>::max(), second_nearest = nearest;
    std::size_t match = 0;
    for (std::size_t j = 0; j < second.key_points.size(); ++j) {
      const int away = squared_distance(first.set.descriptors[i], second.set.descriptors[j]);
      if (away < nearest) match = j;
      second_nearest = std::min(second_nearest, std::max(away, nearest));
      nearest = std::min(nearest, away);
    }
    ++count.features;
    if (!(nearest < ratio * ratio * second_nearest)) continue;
    ++count.matched;
    if (same_thing(i, match)) ++count.right;
  }
  return count;
}

}  // namespace azimuth::test
