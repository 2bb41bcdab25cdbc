#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/geometry/random.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/localisation/view_odds.hpp"

namespace azimuth {

// Closed-form poses from the minimum number of directions.

/// The pose from which two mapped landmarks are at given positions in the body frame. The vector between them
/// determines the heading, their midpoint the position. Nothing when two positions coincide.
std::optional<Pose2> pose_from_pair(const std::array<Eigen::Vector2d, 2>& p_map,
                                    const std::array<Eigen::Vector2d, 2>& p_body);

/// The pose from which three landmarks are seen in three directions (unit vectors in the body frame): three-point
/// resection as in surveying. Nothing when pose and landmarks are on one circle, or nearly so, or when a landmark would
/// have to be behind its direction.
std::optional<Pose2> pose_from_directions(const std::array<Eigen::Vector2d, 3>& p_map,
                                          const std::array<Eigen::Vector2d, 3>& to_landmark);

/// Restricts the search to poses of a robot that was near a given point some time ago.
struct SearchArea {
  Eigen::Vector2d p_map_middle_m = Eigen::Vector2d::Zero();
  double radius_m = std::numeric_limits<double>::infinity();
  Pose2 T_now_then;  ///< Pose of the robot at that time, relative to the present one
  bool contains(const Pose2& T_map_body) const {
    return !(((T_map_body * T_now_then).position() - p_map_middle_m).norm() > radius_m);
  }
};

/// A pose suggested by an image.
struct SuggestedPose {
  Pose2 T_map_body;
  double score = 0.0;  ///< Approximate share of the image that the pose explains, as a sum of weights
};

/// Finds poses that explain an image from minimal samples of directions (RANSAC): two directions with elevations, to
/// landmarks of known height, else three azimuths. Names and kinds limit the landmarks that a direction may belong to.
/// The effort is bounded by a number of comparisons, whatever map and image are.
///
/// Thread contract: thread-bound. Nothing allocates once map and image have had their largest sizes. The same calls
/// give the same results to the last bit.
class PoseSearch {
 public:
  explicit PoseSearch(const RelocalisationSettings& settings);

  void restart();

  /// The best poses for one image, sufficiently distinct, best first. Valid until the next call. `mapped_share` is the
  /// expected share of directions that belong to mapped landmarks. Poses outside the area are skipped.
  std::span<const SuggestedPose> suggest(const KnownMap& map, const RaysOfImage& image, double mapped_share,
                                         const SearchArea& area = {});

  /// Expected number of correct samples in all images since restart(); the contribution of one image is limited. The
  /// probability that the robot's true pose was never suggested is about exp(-right_samples()).
  double right_samples() const { return right_samples_; }

 private:
  using RayPair = std::pair<std::size_t, std::size_t>;
  void prepare(const KnownMap& map, const RaysOfImage& image);
  bool has_spatial_pairs(const KnownMap& map) const;
  void search_pairs(const KnownMap& map, const RaysOfImage& image);
  void try_pair(const KnownMap& map, const RaysOfImage& image, RayPair rays);
  void try_lamps(const KnownMap& map, const RaysOfImage& image, RayPair rays, RayPair lamps);
  void search_triples(const KnownMap& map, const RaysOfImage& image);
  void try_triple(const KnownMap& map, const RaysOfImage& image);
  void judge(const KnownMap& map, const RaysOfImage& image, const Pose2& T_map_body);
  double score(const KnownMap& map, const RaysOfImage& image, const Pose2& T_map_body);
  void keep(const SuggestedPose& pose);
  std::span<const std::uint32_t> candidates(std::size_t ray) const {
    return {&candidates_[first_candidate_[ray]], first_candidate_[ray + 1] - first_candidate_[ray]};
  }

  RelocalisationSettings settings_;
  SplitMix bits_;
  SearchArea area_;
  std::ptrdiff_t checks_left_ = 0;
  double mapped_share_ = 0.5;
  double right_samples_ = 0.0, right_here_ = 0.0;  ///< Right samples of all images, and of the present one
  std::vector<std::size_t> usable_;                ///< Rays that may belong to some landmark
  std::vector<std::uint32_t> candidates_;          ///< Landmarks each ray may belong to, ray after ray
  std::vector<std::size_t> first_candidate_;       ///< Index of each ray's first candidate, and one past the last
  std::vector<Eigen::Vector2d> flat_;              ///< Directions in the plane
  std::vector<double> weight_, tolerance_;         ///< Weight and tolerance of each ray
  double all_weights_ = 0.0;
  std::vector<RayPair> ray_pairs_;
  std::vector<Eigen::Vector3d> from_camera_;
  std::vector<SuggestedPose> kept_;
};

}  // namespace azimuth
