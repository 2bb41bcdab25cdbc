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

/// A pose the robot may have, in the map frame.
struct PoseHypothesis {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad])
  double log_odds = 0.0;                                 ///< of the images, against seeing nothing that is mapped
  double probability = 0.0;                              ///< against the others
  double explained = 0.0;  ///< share of the directions in the last images that are of mapped landmarks
  int images = 0;          ///< it was compared with
  double driven_m = 0.0;   ///< since the first of them
};

/// Where a robot is known to be, roughly.
struct Whereabouts {
  Eigen::Vector2d p_map_robot_m = Eigen::Vector2d::Zero();
  double reach_m = 0.0;  ///< no farther away from there than this; the search widens as the robot drives on
};

/// Finds a robot in a known map that may be anywhere: kidnapped, slipped, or switched on somewhere.
///
/// Each image suggests poses: two directions with elevations to landmarks of known height, or three without, fix one.
/// What is suggested is compared with the whole image and with those before, and the good ones are kept as Gaussians
/// that move with odometry and are corrected by each image. Their odds tell them apart: what is seen where it should
/// be, what should be seen and is not, and what is seen and not mapped. While several places look alike there are
/// several hypotheses, and motion decides; in a map that is exactly symmetric nothing does.
///
/// Knows nothing of filters, and leaves the map as it is.
///
/// Thread contract: thread-bound. Nothing allocates once the hypotheses and the images have had their largest sizes.
/// Same calls, same bits.
class Relocaliser {
 public:
  explicit Relocaliser(const RelocalisationSettings& settings);

  /// Begins anew in this map, with the robot anywhere in it or near it, or only `within`.
  void start(std::span<const KnownLandmark> landmarks, const CameraView& view,
             const std::optional<Whereabouts>& within = {});

  /// The robot moved.
  void predict(const Motion& motion);

  /// Compares an image with the map. Directions that are not finite or have no positive sigma are left out.
  void update(std::span<const SeenDirection> directions);

  /// Those still thought possible, the most probable first.
  std::span<const PoseHypothesis> hypotheses() const { return hypotheses_; }

  /// Whether more than one place explains what was seen well.
  bool is_ambiguous() const;

  /// The robot's pose, when there is hardly a doubt left; its covariance takes the landmarks' errors as independent.
  std::optional<PoseHypothesis> found() const;

 private:
  /// A hypothesis with what it thinks of each landmark.
  struct Tracked {
    PoseHypothesis hypothesis;
    Beliefs beliefs;
    double log_prior = 0.0;      ///< part of the odds: how few poses there are like this
    std::vector<double> recent;  ///< odds of the last images, newest first
    double recently(std::size_t images = std::numeric_limits<std::size_t>::max()) const;
  };
  /// An image, and the motion from there to the next one kept.
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
  std::vector<Tracked> tracked_;  ///< the first `count_` are in use, the best first
  Tracked candidate_;
  std::size_t count_ = 0;
  std::vector<PoseHypothesis> hypotheses_;
  std::vector<Past> past_;  ///< ring
  std::size_t newest_ = 0, remembered_ = 0;
  RaysOfImage image_;
  Motion since_key_;
  double driven_m_ = 0.0;  ///< since the start
  Pose2 T_start_now_;
  std::optional<Whereabouts> within_;
};

}  // namespace azimuth
