#pragma once
// A simulated drive among features that have descriptors instead of names, with the true feature of each bearing.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/evaluate/sighting_error.hpp"

namespace azimuth {

struct FeatureWorldSettings {
  double repeatability = 0.7;              ///< probability that an image shows a feature within range
  double looks_sigma = 9.0;                ///< standard deviation of each descriptor value from view to view
  double look_alikes = 0.1;                ///< share of the features that look nearly like another feature
  double clutter_per_image = 8.0;          ///< number of features per image that never reappear
  double heading_drift_rad2_per_m = 5e-5;  ///< drift of the odometry's heading
};

/// A run in a lab with features along all walls. Its bearings carry descriptors and neighbours.
struct FeatureWorld {
  Run run;
  /// The true feature of each bearing, by stamp and azimuth; clutter has no entry.
  std::unordered_map<std::int64_t, std::unordered_map<double, Identity>> truth;

  /// Number of sightings whose true feature differs from the most frequent true feature of their landmark.
  std::size_t wrong(const std::vector<SightingRecord>& sightings) const;
};

FeatureWorld feature_world(std::uint64_t seed, const FeatureWorldSettings& settings = {});

}  // namespace azimuth
