#pragma once
#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "slam/hypotheses/conditioned_association.hpp"

namespace azimuth {

/// The partial data association of one image, and the pose and landmarks conditioned on it.
///
/// Arguments passed by reference must outlive the object and its copies. Thread contract: thread-bound.
class ImageReading {
 public:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  ImageReading(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
               const ConditionedAssociationSettings& settings);

  std::size_t bearings() const { return sightings_.size(); }
  std::size_t landmarks() const { return belief_.landmarks.size(); }

  /// Computes the scores of all undecided pairs, given the decisions so far.
  void predict();
  /// Score as of the last predict(): ln of the density per radian of this bearing under this landmark; kNever for a
  /// pair that is impossible or already decided.
  double score(std::size_t bearing, std::size_t landmark) const { return scores_[bearing * landmarks() + landmark]; }
  /// Number of landmarks, as of the last predict(), that should have been seen and have no bearing.
  int missed() const;

  bool is_open(std::size_t bearing) const { return landmark_of_[bearing] == kOpen; }
  /// Assigns the bearing to the landmark, and conditions pose and landmarks on it. The scores must be as of the last
  /// predict().
  void take(std::size_t bearing, std::size_t landmark);
  void leave(std::size_t bearing) { landmark_of_[bearing] = kNothing; }

  /// Returns for each bearing the index of its landmark, or -1.
  std::vector<int> landmark_of() const;

 private:
  static constexpr int kNothing = -1, kOpen = -2;
  struct Prediction {
    SeenAzimuth seen;
    Eigen::VectorXd PH;  // covariance of the azimuth with pose and landmarks
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
