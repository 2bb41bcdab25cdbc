#pragma once
// A robot that knows its surroundings, but not its heading.

#include <vector>

#include "slam/hypotheses/conditioned_association.hpp"

namespace azimuth {

/// Landmarks 4 m away at these azimuths. Every entry except the heading has the variance `variance` [m^2, rad^2,
/// 1/m^2].
inline PoseAndLandmarks known_but_for_heading(const std::vector<double>& azimuths, double sigma_heading_rad,
                                              double variance) {
  PoseAndLandmarks belief;
  for (const double azimuth : azimuths) belief.landmarks.emplace_back(Eigen::Vector2d(0.0, 0.0), azimuth, 0.25);
  const auto rows = static_cast<Eigen::Index>(3 + 2 * azimuths.size());
  belief.covariance = variance * Eigen::MatrixXd::Identity(rows, rows);
  belief.covariance(2, 2) = sigma_heading_rad * sigma_heading_rad;
  return belief;
}

}  // namespace azimuth
