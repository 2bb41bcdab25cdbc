#pragma once
// Which bearing of one image is of which landmark, where a pair that is clear makes others clearer.

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "slam/hypotheses/scene.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/factors.hpp"

namespace azimuth {

/// A pose and landmarks with their joint covariance: the pose's (along, left, turn), then (alpha, rho) of each
/// landmark.
struct PoseAndLandmarks {
  SmoothedPose pose;
  std::vector<SmoothedLandmark> landmarks;
  Eigen::MatrixXd covariance;
  std::vector<Kind> kinds;  ///< of the landmarks; empty: of any
};

/// A direction from the pose, with its standard deviation, and of what sort of thing.
struct NamelessSighting {
  double azimuth_rad = 0.0, sigma_rad = 1.0;
  Kind kind = kAnyKind;
};

struct ConditionedAssociationSettings {
  Scene scene;
  double gate_chi2 = 9.0;
  double new_landmark_bonus = 1.5;  ///< by which a landmark must be better than none at all, being counted less by this
  double min_margin = 2.5;          ///< natural logarithm of the odds against the best rival
  std::vector<double> margins;      ///< in place of that, when given, of each landmark
  double min_distance_m = 0.05;     ///< from the pose; others are not asked
  bool reads_whole = true;          ///< where pairs are not clear one by one, the image is read as a whole

  double margin_of(std::size_t landmark) const { return margins.empty() ? min_margin : margins[landmark]; }
  /// What a bearing of nothing that is mapped counts for.
  double log_nothing() const { return std::log(scene.new_per_rad) - new_landmark_bonus; }
};

/// ln N(off; 0, variance)
inline double log_normal_density(double off, double variance) {
  return -0.5 * (off * off / variance + std::log(2.0 * std::numbers::pi * variance));
}

/// For each bearing an index of a landmark, or -1. The pair with the largest margin over its rivals goes first; then
/// pose and landmarks are conditioned on it. Where that leaves bearings open which might be of something, the image is
/// read as a whole instead: see associate_jointly(). Thread contract: reentrant.
std::vector<int> associate_conditioned(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
                                       const ConditionedAssociationSettings& settings);

}  // namespace azimuth
