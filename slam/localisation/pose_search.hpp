#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "slam/geometry/random.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/localisation/view_odds.hpp"

namespace azimuth {

/// Where poses are looked for: those of a robot that was not far from some point a while ago.
struct SearchArea {
  Eigen::Vector2d p_map_middle_m = Eigen::Vector2d::Zero();
  double radius_m = std::numeric_limits<double>::infinity();
  Pose2 T_now_then;  ///< back to where the robot was then
  bool contains(const Pose2& T_map_body) const {
    return !(((T_map_body * T_now_then).position() - p_map_middle_m).norm() > radius_m);
  }
};

/// A pose that an image suggests.
struct SuggestedPose {
  Pose2 T_map_body;
  double score = 0.0;  ///< how much of the image it explains, roughly
};

/// Poses that explain an image, from samples of the fewest directions that fix one (RANSAC): two with elevations, of
/// landmarks of known height, else three azimuths. Names and kinds decide what a direction may be of. The effort is
/// bounded by a number of comparisons, whatever the map and the image are.
///
/// Thread contract: thread-bound. Nothing allocates once map and image have had their largest sizes. Same calls, same
/// bits.
class PoseSearch {
 public:
  explicit PoseSearch(const RelocalisationSettings& settings);

  void restart();

  /// The best poses of one image, far enough from each other, best first. Valid until the next call. `mapped_share` of
  /// the directions should be of mapped landmarks. Poses outside the area are passed over.
  std::span<const SuggestedPose> suggest(const KnownMap& map, const RaysOfImage& image, double mapped_share,
                                         const SearchArea& area = {});

  /// How many of the samples of all images since the restart should have been right ones: one image counts for a few
  /// at most. The chance that the robot's true pose was never thought of is about e to minus this.
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
  double right_samples_ = 0.0, right_here_ = 0.0;  ///< of all images, and of this one
  std::vector<std::size_t> usable_;                ///< rays that may be of some landmark
  std::vector<std::uint32_t> candidates_;          ///< landmarks each ray may be of, ray after ray
  std::vector<std::size_t> first_candidate_;       ///< of each ray, and one past the last
  std::vector<Eigen::Vector2d> flat_;              ///< directions in the plane
  std::vector<double> weight_, tolerance_;         ///< of each ray
  double all_weights_ = 0.0;
  std::vector<RayPair> ray_pairs_;
  std::vector<Eigen::Vector3d> from_camera_;
  std::vector<SuggestedPose> kept_;
};

}  // namespace azimuth
