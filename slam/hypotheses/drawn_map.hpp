#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/random.hpp"
#include "slam/hypotheses/conditioned_association.hpp"
#include "slam/hypotheses/hypothesis.hpp"
#include "slam/smoother/factors.hpp"

namespace azimuth {

/// How maps are drawn (SPEC VI.31).
struct DrawnMapSettings {
  /// Of these, the scene, the landmarks' prior and least distance, and how tracks begin and end.
  HypothesisSettings hypothesis;
  /// A bearing closes no loop where it is predicted no better than to this share of the field of view, standard
  /// deviation: what else stands there nobody knows.
  double vague_share_of_view = 0.25;
  int most_landmarks = 100;  ///< those out of sight for longest are forgotten
};

using Draws = RandomNumbers<Xoshiro>;

/// A map of landmarks all alike, and the robot in it: one joint Gaussian, in which it was drawn by the odds what each
/// bearing is of (SPEC VI.31). That many such maps differ says what is not known. Errors are invariant ones (VI.2):
/// what is seen never says anything of how the whole map lies.
///
/// Thread contract: thread-bound. Same calls, same bits. Copies are deep.
class DrawnMap {
 public:
  DrawnMap() : P_(Eigen::MatrixXd::Zero(kPose, kPose)) {}

  /// The robot moved.
  void move(const Motion& motion);
  /// Draws what each of an image's bearings is of, and takes it in. Returns ln of the density of having seen that.
  double take(std::span<const NamelessSighting> sightings, const DrawnMapSettings& settings, double now_s,
              Draws& draws);

  const Pose2& pose() const { return pose_; }
  Eigen::Matrix3d pose_covariance() const { return P_.topLeftCorner<3, 3>(); }  ///< of (x, y, heading), in the map
  std::size_t landmarks() const { return landmarks_.size(); }
  const SmoothedLandmark& landmark(std::size_t i) const { return landmarks_[i].where; }
  /// Of the pose's (x, y, heading), then of each landmark's (alpha, rho), as it lies to the robot: an error of the pose
  /// moves and turns the whole map along with it, and is no error of a landmark.
  const Eigen::MatrixXd& covariance() const { return P_; }

 private:
  using Index = Eigen::Index;
  static constexpr Index kPose = 3;

  struct Landmark {
    SmoothedLandmark where;
    Kind kind = kAnyKind;
    int sightings = 1, missed = 0;  // missed: in images that should have shown it
    double seen_s = 0.0;            // last
  };
  /// A bearing of a landmark, predicted.
  struct Predicted {
    double azimuth_rad = 0.0, variance = 0.0;
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();  // (alpha, rho)
  };
  /// What a bearing may be of.
  struct Choice {
    std::size_t landmark = 0;
    double density = 0.0, off_rad = 0.0, variance = 0.0;
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();
  };
  static Index entry_of(std::size_t landmark) { return kPose + 2 * static_cast<Index>(landmark); }
  Eigen::Matrix<double, 2, 3> by_moving_all(const SmoothedLandmark& landmark) const;
  bool predict(std::size_t landmark, double min_distance_m, Predicted& out) const;
  std::vector<char> should_be_seen(const DrawnMapSettings& settings) const;
  double choose(const NamelessSighting& sighting, const DrawnMapSettings& settings, double now_s,
                const std::vector<char>& taken, Draws& draws, int& chosen);
  void correct(const Choice& choice);
  std::size_t add_landmark(const NamelessSighting& sighting, const DrawnMapSettings& settings);
  void forget_some(const DrawnMapSettings& settings, double now_s);
  void keep_only(const std::vector<char>& kept);
  void move_by(const Eigen::VectorXd& step);

  Pose2 pose_;
  Eigen::MatrixXd P_;
  std::vector<Landmark> landmarks_;
  std::vector<Choice> choices_;  // storage
};

}  // namespace azimuth
