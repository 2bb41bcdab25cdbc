#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "slam/association/assignment.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/localisation/view_odds.hpp"

namespace azimuth {

/// A pose and its covariance.
struct PoseGaussian {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The pose predicted by a motion: G P G^T + R Q R^T.
inline PoseGaussian moved(const PoseGaussian& pose, const Motion& motion) {
  const MovedPose to = apply(pose.T_map_body, motion);
  return {to.T_map_body, to.G * pose.covariance * to.G.transpose() + to.noise};
}

/// For each landmark the probability that it is still there (or lit), according to one hypothesis. A landmark that has
/// gone is missed in every image, which must count only once.
using LitOdds = std::vector<float>;

/// The share of directions that belong to mapped landmarks, as learned by one hypothesis.
class MappedShare {
 public:
  explicit MappedShare(double expected = 0.5) : mapped_(kPrior * expected), unmapped_(kPrior * (1.0 - expected)) {}
  double value() const { return std::clamp(mapped_ / (mapped_ + unmapped_), kLeast, 1.0 - kLeast); }
  void learn(std::size_t mapped, std::size_t unmapped);

 private:
  static constexpr double kLeast = 0.05;   // lower limit, and upper limit of the complement
  static constexpr double kPrior = 4.0;    // weight of the expected share, in directions
  static constexpr double kMemory = 60.0;  // number of directions remembered
  double mapped_, unmapped_;
};

/// The states of a hypothesis besides its pose.
struct Beliefs {
  LitOdds lit;  ///< One entry per landmark
  MappedShare share;
};

/// Result of comparing a pose with an image.
struct Compared {
  PoseGaussian pose;      ///< Corrected by the image
  double log_odds = 0.0;  ///< Log odds of the image given the pose, against an image without mapped landmarks
  /// Log of the prior of a suggested pose: the share of all poses in the map that explain the image as well as this
  /// pose does
  double log_prior = 0.0;
  int explained = 0;  ///< Directions that belong to mapped landmarks
};

/// Compares an image with the map as seen from a pose.
///
/// Directions are assigned to landmarks one to one so that the odds are largest, and the pose is corrected by least
/// squares. A direction assigned to a landmark counts by its density under the covariances of pose, landmark and
/// direction, relative to a uniform density over the view; no threshold decides which distance is near. If the
/// detection probability is known, a landmark in view that is not seen counts against the pose.
///
/// Thread contract: thread-bound. Nothing allocates once map and images have had their largest sizes.
class ImageMatch {
 public:
  explicit ImageMatch(const RelocalisationSettings& settings) : settings_(settings) {}

  /// Compares from a pose predicted by the previous images, and updates `beliefs`. With several assignments, each
  /// starts from the pose found by the one before, so that directions that fit only the prediction are dropped.
  std::optional<Compared> compare(const KnownMap& map, const RaysOfImage& image, const PoseGaussian& predicted,
                                  Beliefs& beliefs, int assignments = 1);

  /// Compares from a pose that the image itself suggested. The prior of such a pose is uniform over the map. The odds
  /// are those of the best pose nearby.
  std::optional<Compared> compare_suggested(const KnownMap& map, const RaysOfImage& image, const Pose2& suggested,
                                            Beliefs& beliefs);

 private:
  struct Seen {
    std::size_t landmark;
    Eigen::Vector3d from_camera;
    InView in_view;
    bool hit;
  };
  struct Pairing {
    std::size_t ray, landmark;
  };
  /// The least-squares pose and the terms of its likelihood.
  struct Solution {
    PoseGaussian pose;
    double log_information = 0.0;  ///< ln |covariance^-1|
    double chi2 = 0.0;             ///< Chi-square of the residuals
    double log_noise = 0.0;        ///< Sum of ln |2 pi noise|
  };
  void look(const KnownMap& map, const Pose2& T_map_body);
  void assign(const KnownMap& map, const RaysOfImage& image, const PoseGaussian& pose, const Beliefs& beliefs);
  double value_of(const KnownMap& map, const RaysOfImage& image, std::size_t ray, const Seen& seen,
                  const PoseGaussian& pose, const Beliefs& beliefs) const;
  double log_detected(const KnownMap& map, const Seen& seen, const Beliefs& beliefs) const;
  std::optional<Solution> solve(const KnownMap& map, const RaysOfImage& image, const Pose2& start,
                                const PoseGaussian* prior) const;
  double odds_of_pairings(const KnownMap& map, const RaysOfImage& image, const Beliefs& beliefs) const;
  double odds_of_misses(const KnownMap& map, LitOdds& lit) const;

  RelocalisationSettings settings_;
  Assignment assignment_;
  std::vector<Seen> seen_;
  double in_view_ = 1.0;  ///< Number of landmarks in view, at least one
  std::vector<double> values_, alone_;
  std::vector<int> column_of_row_;
  std::vector<Pairing> pairings_;
};

}  // namespace azimuth
