#pragma once
// A simulated drive among features that have looks instead of names, with the truth about which is which.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/evaluate/sighting_error.hpp"

namespace azimuth {

struct FeatureWorldSettings {
  double repeatability = 0.7;              ///< share of the features in reach that an image shows
  double looks_sigma = 9.0;                ///< noise of each value of a descriptor, from view to view
  double look_alikes = 0.1;                ///< share of the features that look nearly like another
  double clutter_per_image = 8.0;          ///< features never seen again
  double heading_drift_rad2_per_m = 5e-5;  ///< of the odometry
};

/// A run whose bearings carry descriptors and neighbours, in a lab with features all along its walls.
struct FeatureWorld {
  Run run;
  /// By stamp and azimuth of each bearing: the feature it is of; absent for clutter.
  std::unordered_map<std::int64_t, std::unordered_map<double, Identity>> truth;

  /// Of the sightings: how many are not of what most sightings of their landmark are of.
  std::size_t wrong(const std::vector<SightingRecord>& sightings) const;
};

FeatureWorld feature_world(std::uint64_t seed, const FeatureWorldSettings& settings = {});

}  // namespace azimuth
