#pragma once
#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "slam/hypotheses/conditioned_association.hpp"

namespace azimuth {

/// What the bearings of one image are of, as far as it is decided, and what pose and landmarks are then.
///
/// What is passed by reference must outlive it and its copies. Thread contract: thread-bound.
class ImageReading {
 public:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  ImageReading(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
               const ConditionedAssociationSettings& settings);

  std::size_t bearings() const { return sightings_.size(); }
  std::size_t landmarks() const { return belief_.landmarks.size(); }

  /// Scores what is open, by what is decided so far.
  void predict();
  /// From the last predict(): ln of the density by angle of a bearing of this landmark; kNever for what cannot be, or
  /// is decided.
  double score(std::size_t bearing, std::size_t landmark) const { return scores_[bearing * landmarks() + landmark]; }
  /// From the last predict(): how many landmarks should have been seen that no bearing is of.
  int missed() const;

  bool is_open(std::size_t bearing) const { return landmark_of_[bearing] == kOpen; }
  /// Pose and landmarks are conditioned on it. The score must be of the last predict().
  void take(std::size_t bearing, std::size_t landmark);
  void leave(std::size_t bearing) { landmark_of_[bearing] = kNothing; }

  /// For each bearing an index of a landmark, or -1.
  std::vector<int> landmark_of() const;

 private:
  static constexpr int kNothing = -1, kOpen = -2;
  struct Prediction {
    SeenAzimuth seen;
    Eigen::VectorXd PH;  // covariance with everything
    double variance = 0.0, distance_m = 0.0;
    bool possible = false;
  };

  double score_of(std::size_t bearing, std::size_t landmark) const;
  bool should_be_seen(const Prediction& prediction) const;

  PoseAndLandmarks belief_;
  std::span<const NamelessSighting> sightings_;
  const ConditionedAssociationSettings* settings_;
  double log_detection_;
  std::vector<int> landmark_of_;
  std::vector<char> taken_;
  std::vector<Prediction> predictions_;
  std::vector<double> scores_;
};

}  // namespace azimuth
