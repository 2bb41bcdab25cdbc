#pragma once
// Which landmarks that were found at different times may be one.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "slam/smoother/factors.hpp"

namespace azimuth {

/// Landmarks with their joint covariance, (alpha, rho) of each.
struct LandmarkBeliefs {
  std::vector<SmoothedLandmark> landmarks;
  Eigen::MatrixXd covariance;
};

/// Two of them, by their places in the list: the one found first, the other.
struct LandmarkPair {
  std::size_t older = 0, newer = 0;
  friend bool operator==(const LandmarkPair&, const LandmarkPair&) = default;
};

struct SameLandmarksSettings {
  double gate_chi2 = 9.2;      ///< by two degrees of freedom
  double log_detection = 0.0;  ///< ln of the probability that a landmark is seen
  double log_new = 0.0;        ///< ln of the density by direction of landmarks not mapped yet
  double inverse_depth_mean_per_m = 0.35, inverse_depth_sigma_per_m = 0.25;  ///< of those
  double min_margin = 3.0;  ///< natural logarithm of the odds against the best rival
};

/// Those of `possible` that are one, in the order in which that became clear. Two are compared in the chart of the
/// vaguer one, by their joint covariance, against chance: that the newer is a landmark of its own. The pair that is
/// furthest ahead of its rivals goes first, and all are conditioned on it. Rivals that could be one themselves are
/// none. Thread contract: reentrant.
std::vector<LandmarkPair> same_landmarks(LandmarkBeliefs beliefs, std::span<const LandmarkPair> possible,
                                         const SameLandmarksSettings& settings);

}  // namespace azimuth
