#pragma once
#include "slam/sample/map_snapshot.hpp"
#include "tests/association/random_descriptors.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {

struct RandomMapSettings {
  std::size_t landmarks = 8;
  std::size_t camera = 3;
  std::size_t views_each = 0;  ///< greater than 0: descriptors identify the landmarks
  bool heights = false;
};

/// A map as an estimator might save it, with full correlations and gaps between the ids.
inline MapSnapshot random_map(unsigned seed, const RandomMapSettings& settings = {}) {
  RandomDraws draws(seed);
  MapSnapshot map;
  map.stamp = stamp_from_us(1'700'000'000'000'000 + draws.integer(0, 1'000'000'000));
  map.T_map_body = draws.pose(10.0);
  for (std::size_t i = 0; i < settings.camera; ++i) map.camera.push_back(draws.normal());
  map.names = settings.views_each > 0 ? MapNames::looks : MapNames::none;
  for (std::size_t i = 0; i < settings.landmarks; ++i) {
    MapLandmark& landmark = map.landmarks.emplace_back();
    landmark.id = map.next_id;
    map.next_id += draws.integer(1, 3);
    landmark.kind = draws.integer(-1, 3);
    landmark.sightings = static_cast<std::uint64_t>(draws.integer(1, 1000));
    landmark.p_map_landmark_m = draws.point(30.0);
    if (settings.heights) landmark.z_map_landmark_m = draws.uniform(2.0, 4.0);
    if (settings.views_each == 0) continue;
    landmark.identity = map.next_identity;
    map.next_identity += draws.integer(1, 5);
    for (std::size_t k = 0; k < settings.views_each; ++k)
      map.views.push_back({landmark.identity, draws.point(30.0), random_descriptor(draws)});
  }
  const Eigen::MatrixXd P = draws.covariance(static_cast<Eigen::Index>(map.entries()), 0.1);
  map.covariance.resize(map.entries());
  for (std::size_t c = 0; c < map.entries(); ++c)
    for (std::size_t r = c; r < map.entries(); ++r)
      map.covariance(r, c) = P(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
  return map;
}

}  // namespace azimuth
