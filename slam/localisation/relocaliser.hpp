#pragma once
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/localisation/image_match.hpp"
#include "slam/localisation/known_map.hpp"
#include "slam/localisation/pose_search.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// A possible pose of the robot, in the map frame.
struct PoseHypothesis {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad])
  double log_odds = 0.0;                                 ///< Log odds of the images, against clutter only
  double probability = 0.0;                              ///< Probability against the other hypotheses
  double explained = 0.0;  ///< Share of the directions in the last images that belong to mapped landmarks
  int images = 0;          ///< Number of images with which the pose was compared
  double driven_m = 0.0;   ///< Distance driven since the first of these images
};

/// An approximately known position of the robot.
struct PositionPrior {
  Eigen::Vector2d p_map_robot_m = Eigen::Vector2d::Zero();
  double reach_m = 0.0;  ///< Greatest distance from p_map_robot_m; the search area widens as the robot drives on
};

/// Relocalisation: finds a robot that may be anywhere in a known map (kidnapped, slipped, or switched on at an unknown
/// place).
///
/// Each image suggests poses, computed from two directions with elevations to landmarks of known height, or from three
/// directions without elevations. A suggested pose is compared with the whole image and with previous images. Good
/// poses are kept as Gaussian hypotheses that move with odometry and are corrected by each image. The hypotheses differ
/// in their odds, which result from landmarks seen where they should be, landmarks missed, and directions without a
/// mapped landmark. While several places look alike there are several hypotheses, and motion decides between them; in
/// an exactly symmetric map it cannot.
///
/// Independent of any filter; never changes the map.
///
/// Thread contract: thread-bound. Nothing allocates once the hypotheses and the images have had their largest sizes.
/// The same calls give the same results to the last bit.
class Relocaliser {
 public:
  explicit Relocaliser(const RelocalisationSettings& settings);

  /// Starts a search in this map, with the robot anywhere in or near the map, or only `within`.
  void start(std::span<const KnownLandmark> landmarks, const CameraView& view,
             const std::optional<PositionPrior>& within = {});

  /// The robot moved.
  void predict(const Motion& motion);

  /// Compares an image with the map. Directions that are not finite or have no positive sigma are left out.
  void update(std::span<const SeenDirection> directions);

  /// The remaining hypotheses, most probable first.
  std::span<const PoseHypothesis> hypotheses() const { return hypotheses_; }

  /// Whether more than one place explains the images well.
  bool is_ambiguous() const;

  /// The robot's pose, once hardly any doubt is left. Its covariance treats the landmarks' errors as independent.
  std::optional<PoseHypothesis> found() const;

 private:
  /// A hypothesis with its belief about each landmark.
  struct Tracked {
    PoseHypothesis hypothesis;
    Beliefs beliefs;
    double log_prior = 0.0;      ///< Part of the odds: the share of all poses that are like this one
    std::vector<double> recent;  ///< Log odds of the last images, newest first
    double recently(std::size_t images = std::numeric_limits<std::size_t>::max()) const;
  };
  /// A past image, and the motion from it to the next one kept.
  struct Past {
    RaysOfImage image;
    Motion to_next;
  };
  bool is_key() const;
  void compare_all();
  void correct(Tracked& tracked, const Compared& compared, std::size_t directions) const;
  SearchArea area() const;
  double share_searched() const;
  void add(const Pose2& suggested);
  bool explain_past(PoseGaussian pose, const Tracked* leader);
  bool is_known(const PoseGaussian& pose) const;
  void sort();
  void drop_worthless();
  void publish();
  void remember();
  std::size_t past_index(std::size_t images_ago) const { return (newest_ + past_.size() - images_ago) % past_.size(); }

  RelocalisationSettings settings_;
  KnownMap map_;
  ImageMatch match_;
  PoseSearch search_;
  std::vector<Tracked> tracked_;  ///< The first `count_` are in use, best first
  Tracked candidate_;
  std::size_t count_ = 0;
  std::vector<PoseHypothesis> hypotheses_;
  std::vector<Past> past_;  ///< Ring
  std::size_t newest_ = 0, remembered_ = 0;
  RaysOfImage image_;
  Motion since_key_;
  double driven_m_ = 0.0;  ///< Distance driven since the start
  Pose2 T_start_now_;
  std::optional<PositionPrior> within_;
};

}  // namespace azimuth
