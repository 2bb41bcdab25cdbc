#pragma once
// Data association of one image: each accepted pair of bearing and landmark updates the belief and so makes other pairs
// clearer.

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "slam/hypotheses/scene.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/factors.hpp"

namespace azimuth {

class ImageReading;

/// A pose and landmarks with their joint covariance: the pose's (along, left, turn), then (alpha, rho) of each
/// landmark.
struct PoseAndLandmarks {
  SmoothedPose pose;
  std::vector<SmoothedLandmark> landmarks;
  Eigen::MatrixXd covariance;
  std::vector<Kind> kinds;  ///< kinds of the landmarks; empty: any kind
};

/// A bearing without an identity: azimuth, standard deviation and kind.
struct NamelessSighting {
  double azimuth_rad = 0.0, sigma_rad = 1.0;
  Kind kind = kAnyKind;
};

struct ConditionedAssociationSettings {
  Scene scene;
  double gate_chi2 = 9.0;
  double new_landmark_bonus = 1.5;  ///< subtracted from ln of the density of new landmarks
  double min_margin = 2.5;          ///< minimum ln of the odds against the best rival
  std::vector<double> margins;      ///< replaces min_margin per landmark, if not empty
  double min_distance_m = 0.05;     ///< nearer landmarks are ignored
  bool reads_whole = true;          ///< whether an image with unclear pairs is associated jointly

  double margin_of(std::size_t landmark) const { return margins.empty() ? min_margin : margins[landmark]; }
  /// Score of a bearing that belongs to no mapped landmark.
  double log_nothing() const { return std::log(scene.new_per_rad) - new_landmark_bonus; }
};

/// ln N(off; 0, variance)
inline double log_normal_density(double off, double variance) {
  return -0.5 * (off * off / variance + std::log(2.0 * std::numbers::pi * variance));
}

/// Returns for each bearing the index of its landmark, or -1. The pair with the largest margin over its rivals is
/// accepted first, and pose and landmarks are conditioned on it. If bearings stay undecided that could belong to a
/// landmark, the whole image is associated jointly instead: see associate_jointly(). Thread contract: reentrant.
std::vector<int> associate_conditioned(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
                                       const ConditionedAssociationSettings& settings);

/// Associates all bearings of an image jointly, for images in which single pairs are not clear: two bearings that agree
/// with each other may outweigh a nearer one, and a landmark that should be seen supports the bearing that may belong
/// to it. Starting from the undecided `start`, the function follows the most likely readings of the image, bearing by
/// bearing. It accepts a pair when its odds over all these readings reach the margin of the settings. Returns for each
/// bearing the index of its landmark, or -1. Thread contract: reentrant.
std::vector<int> associate_jointly(const ImageReading& start, const ConditionedAssociationSettings& settings);

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
