#pragma once
// Internal to tools/map_export.

#include <Eigen/Core>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Calls `use(landmark, covariance)` for each landmark, with the covariance of its coordinates [m^2]. The entries of
/// the height are zero for a landmark without a height.
template <class Use>
void for_each_landmark(const MapSnapshot& map, const Use& use) {
  std::size_t first = map.first_landmark_entry();
  for (const MapLandmark& landmark : map.landmarks) {
    Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
    for (std::size_t r = 0; r < landmark.size(); ++r)
      for (std::size_t c = 0; c < landmark.size(); ++c)
        P(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = map.covariance(first + r, first + c);
    use(landmark, P);
    first += landmark.size();
  }
}

}  // namespace azimuth
