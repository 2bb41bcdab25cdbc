#pragma once
// Detection of duplicates: landmarks found at different times that may be one landmark.

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

/// A pair of landmarks, as indices in the list; `older` was found first.
struct LandmarkPair {
  std::size_t older = 0, newer = 0;
  friend bool operator==(const LandmarkPair&, const LandmarkPair&) = default;
};

struct SameLandmarksSettings {
  double gate_chi2 = 9.2;      ///< for two degrees of freedom
  double log_detection = 0.0;  ///< ln of the detection probability
  double log_new = 0.0;        ///< ln of the density per radian of unmapped landmarks
  double inverse_depth_mean_per_m = 0.35, inverse_depth_sigma_per_m = 0.25;  ///< prior of unmapped landmarks
  double min_margin = 3.0;  ///< minimum ln of the odds against the best rival
};

/// Returns the pairs of `possible` that are duplicates, in the order in which they were accepted. A pair is compared in
/// the chart of its more uncertain landmark, with the joint covariance, against the alternative that this landmark is
/// separate from the other one. The pair with the largest margin over its rivals is accepted first, and all landmarks
/// are conditioned on it. Two rivals that could themselves be one landmark do not count as rivals. Thread contract:
/// reentrant.
std::vector<LandmarkPair> same_landmarks(LandmarkBeliefs beliefs, std::span<const LandmarkPair> possible,
                                         const SameLandmarksSettings& settings);

}  // namespace azimuth
