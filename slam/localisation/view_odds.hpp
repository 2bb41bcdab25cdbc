#pragma once
// Which landmarks are in view from a pose, and the density of a direction that belongs to none of them.

#include <span>
#include <vector>

#include "slam/localisation/direction_model.hpp"
#include "slam/localisation/known_map.hpp"
#include "slam/localisation/landmark_pairs.hpp"

namespace azimuth {

/// The map in which the robot is searched for.
struct KnownMap {
  std::vector<KnownLandmark> landmarks;
  CameraView view;
  LandmarkPairs pairs;
  double log_prior_density = 0.0;  ///< Prior density of a pose anywhere in the map or near it [1 / (m^2 rad)]
  Eigen::Vector2d low_m, high_m;   ///< Limits of such poses
  double tan_min_elevation = 0.0, tan_inner_elevation = 0.0;

  /// Greatest number of landmarks; further landmarks are left out.
  static constexpr std::size_t kMost = 2000;
  void assign(std::span<const KnownLandmark> all, const CameraView& camera);
  bool contains(const Pose2& T_map_body) const;
};

enum class InView : unsigned char { no, at_the_rim, yes };
InView in_view(const KnownMap& map, const KnownLandmark& landmark, const Eigen::Vector3d& from_camera);

/// The directions of one image.
struct RaysOfImage {
  std::vector<SeenRay> rays;
  std::vector<double> log_room;  ///< ln of the view's size over the share of landmarks each ray may belong to

  /// Takes at most `most` of the directions, at regular intervals.
  void assign(std::span<const SeenDirection> directions, const KnownMap& map, std::size_t most);
};

}  // namespace azimuth
