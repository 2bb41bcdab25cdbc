#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "slam/association/assignment.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/localisation/view_odds.hpp"

namespace azimuth {

/// A pose and how well it is known.
struct PoseGaussian {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// After a motion and nothing else: G P G^T + R Q R^T.
inline PoseGaussian moved(const PoseGaussian& pose, const Motion& motion) {
  const MovedPose to = apply(pose.T_map_body, motion);
  return {to.T_map_body, to.G * pose.covariance * to.G.transpose() + to.noise};
}

/// How probable it is that each landmark is still there, as one hypothesis sees it. What is gone is missed in every
/// image, which must count once.
using LitOdds = std::vector<float>;

/// What share of the directions is of mapped landmarks, as one hypothesis learns it.
class MappedShare {
 public:
  explicit MappedShare(double expected = 0.5) : mapped_(kPrior * expected), unmapped_(kPrior * (1.0 - expected)) {}
  double value() const { return std::clamp(mapped_ / (mapped_ + unmapped_), kLeast, 1.0 - kLeast); }
  void learn(std::size_t mapped, std::size_t unmapped);

 private:
  static constexpr double kLeast = 0.05;   // nothing is certain
  static constexpr double kPrior = 4.0;    // what is expected counts as so many directions
  static constexpr double kMemory = 60.0;  // and no more than these are remembered
  double mapped_, unmapped_;
};

/// What a hypothesis knows beside its pose.
struct Beliefs {
  LitOdds lit;  ///< an entry for each landmark
  MappedShare share;
};

/// What became of a pose that was compared with an image.
struct Compared {
  PoseGaussian pose;       ///< corrected by the image
  double log_odds = 0.0;   ///< of the image given the pose, against an image of nothing that is mapped
  double log_prior = 0.0;  ///< of a suggested pose: the share of all poses that explain the image as well
  int explained = 0;       ///< directions that are of mapped landmarks
};

/// Compares images with the map, as seen from a pose.
///
/// The directions are given to the landmarks one to one so that the odds are largest, and the pose is corrected by
/// least squares. A direction of a landmark counts by its density under the pose's, the landmark's and its own
/// covariance, against its being anywhere in the view; so no threshold decides how near is near. With a known
/// probability of detection a landmark in view that is not seen counts against the pose.
///
/// Thread contract: thread-bound. Nothing allocates once map and images have had their largest sizes.
class ImageMatch {
 public:
  explicit ImageMatch(const RelocalisationSettings& settings) : settings_(settings) {}

  /// From a pose predicted by what happened before. `beliefs` are brought up to date. With more than one assignment,
  /// each from where the one before has the pose, directions that fit the prediction alone are left out in the end.
  std::optional<Compared> compare(const KnownMap& map, const RaysOfImage& image, const PoseGaussian& predicted,
                                  Beliefs& beliefs, int assignments = 1);

  /// From a pose that the image itself suggested: all that is known before is that it lies in the map. The odds are
  /// those of the best pose nearby.
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
  /// The least-squares pose, with what its likelihood is made of.
  struct Solution {
    PoseGaussian pose;
    double log_information = 0.0;  ///< ln |covariance^-1|
    double chi2 = 0.0;             ///< of the residuals
    double log_noise = 0.0;        ///< sum of ln |2 pi noise|
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
  double in_view_ = 1.0;  ///< landmarks, at least one
  std::vector<double> values_, alone_;
  std::vector<int> column_of_row_;
  std::vector<Pairing> pairings_;
};

}  // namespace azimuth
