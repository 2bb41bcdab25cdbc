#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/random.hpp"
#include "slam/hypotheses/believed_pose.hpp"
#include "slam/hypotheses/conditioned_association.hpp"
#include "slam/hypotheses/hypothesis.hpp"
#include "slam/hypotheses/workers.hpp"
#include "slam/smoother/factors.hpp"

namespace azimuth {

/// Settings of drawn maps (mathematics VI.31).
struct DrawnMapSettings {
  /// Only the scene, the prior and least distance of landmarks, and the conditions under which tracks start and end are
  /// used.
  HypothesisSettings hypothesis;
  /// A bearing whose predicted azimuth has a standard deviation above this share of the field of view closes no loop,
  /// since unknown landmarks may lie in the same direction.
  double vague_share_of_view = 0.25;
  int most_landmarks = 100;  ///< above this number, landmarks unseen for longest are removed
};

using Draws = RandomNumbers<Xoshiro>;

/// A map of landmarks that all look alike, and the robot's pose: one joint Gaussian. The association of each bearing
/// was drawn at random by its odds (mathematics VI.31), so the differences between many such maps show the uncertainty
/// of the association. Errors are invariant ones (VI.2): bearings never carry information on the pose of the whole map.
///
/// Thread contract: thread-bound. The same calls give the same bits. Copies are deep.
class DrawnMap {
 public:
  DrawnMap() : P_(Eigen::MatrixXd::Zero(kPose, kPose)) {}

  /// Adds a motion of the robot.
  void move(const Motion& motion);
  /// Draws the association of each of an image's bearings and updates the map. Returns ln of the probability density of
  /// the image.
  double take(std::span<const NamelessSighting> sightings, const DrawnMapSettings& settings, double now_s,
              Draws& draws);

  const Pose2& pose() const { return pose_; }
  Eigen::Matrix3d pose_covariance() const { return P_.topLeftCorner<3, 3>(); }  ///< of (x, y, heading), in the map
  std::size_t landmarks() const { return landmarks_.size(); }
  const SmoothedLandmark& landmark(std::size_t i) const { return landmarks_[i].where; }
  /// Covariance of the pose's (x, y, heading), then of each landmark's (alpha, rho) relative to the robot. An error of
  /// the pose moves and turns the whole map, and is no error of a landmark.
  const Eigen::MatrixXd& covariance() const { return P_; }

 private:
  using Index = Eigen::Index;
  static constexpr Index kPose = 3;

  struct Landmark {
    SmoothedLandmark where;
    Kind kind = kAnyKind;
    int sightings = 1, missed = 0;  // missed: images since the last bearing that should have shown the landmark
    double seen_s = 0.0;            // time of the last bearing
  };
  /// The predicted azimuth of a landmark.
  struct Predicted {
    double azimuth_rad = 0.0, variance = 0.0;
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();  // (alpha, rho)
  };
  /// A candidate landmark for a bearing.
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
  std::vector<Choice> choices_;  // temporary storage
};

struct DrawnMapsSettings {
  DrawnMapSettings map;
  int populations = 16, members = 10;  ///< members: maps per population
};

/// Pose of the robot from many drawn maps (mathematics VI.31), in parallel populations. Within a population, maps that
/// predict badly are replaced by copies of maps that predict well. Populations exchange nothing, so their mean and
/// spread are those of independent answers.
///
/// Thread contract: thread-bound; work is distributed by `workers`. The same calls give the same bits, regardless of
/// the workers.
class DrawnMaps {
 public:
  explicit DrawnMaps(const DrawnMapsSettings& settings);

  /// Adds the first image, at the start of the map.
  void begin(std::span<const NamelessSighting> sightings, Workers& workers);
  /// Adds the next image, at the end of `motion` and `after_s` after the image before.
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers, double after_s);

  /// Pose at the last image.
  BelievedPose pose() const { return belief_; }

 private:
  struct Population {
    Draws draws;
    std::vector<DrawnMap> maps;
    std::vector<double> log_weights;
    BelievedPose belief{};
  };
  void take(std::span<const NamelessSighting> sightings, Workers& workers, const Motion* motion);
  static void weigh(Population& population);
  static void resample(Population& population);
  void conclude();

  DrawnMapsSettings settings_;
  std::vector<Population> populations_;
  BelievedPose belief_;
  double now_s_ = 0.0;
};

}  // namespace azimuth
