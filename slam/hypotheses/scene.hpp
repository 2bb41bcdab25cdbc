#pragma once
#include <span>

#include "slam/smoother/bearing_graph.hpp"
#include "slam/smoother/smoother_settings.hpp"

namespace azimuth {

/// Detection model of a camera in its surroundings: detection probability, range and clutter.
struct Scene {
  double sigma_bearing_rad = 0.0262;             ///< standard deviation of an azimuth
  double field_of_view_rad = 6.283185307179586;  ///< full angle about the heading; 2 pi: all round
  double range_m = 6.0;                          ///< distance up to which landmarks are detected
  double range_doubt = 0.3;                      ///< relative amount by which the true range may exceed range_m
  double detection_probability = 0.75;           ///< of a landmark in view and within range
  // Densities per radian of the bearings of one image.
  double clutter_per_rad = 0.2;  ///< of clutter
  double new_per_rad = 0.4;      ///< of landmarks that are not mapped yet

  /// Lower bound of range_doubt. Distances of landmarks are uncertain, and some landmarks are seen from further away.
  static constexpr double kLeastRangeDoubt = 0.1;
  /// Landmarks further away than this are not considered in data association.
  double asked_within_m() const { return (1.0 + range_doubt) * range_m; }
  /// Landmarks nearer than this should be detected. The value is below the range, which is not known exactly.
  double surely_seen_within_m() const { return 0.9 * range_m; }
  bool sees_all_round() const;
  /// Whether the field of view is too narrow to find a landmark from several images together. Through 140 degrees a
  /// landmark stays in view long enough, through 60 degrees it does not.
  bool is_narrow() const { return field_of_view_rad < 1.75; }
  /// Number of images that show as much as one image of a camera that sees all round.
  double images_for_all_round() const;
  /// Whether a direction from the robot is in view.
  bool in_view(double azimuth_rad) const;
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Costs of a hypothesis besides half the squared residuals: natural logarithms of odds (mathematics VI.20).
struct HypothesisCosts {
  double unassigned = 0.0;  ///< of clutter, against a bearing exactly at a landmark's predicted azimuth
  double landmark = 0.0;    ///< of each landmark
  double missed = 0.0;      ///< of each missed detection
  friend bool operator==(const HypothesisCosts&, const HypothesisCosts&) = default;
};
HypothesisCosts hypothesis_costs(const Scene& scene, const SmootherSettings& smoother);

/// The field of view (full angle about the heading) learned from the azimuths of the bearings so far. It is the largest
/// angle, up to `given_rad`, for which the absence of bearings beyond the widest one has a probability of at least 5 %.
/// A camera that should see all round may be mounted where it does not, and landmarks behind it would count as missed.
/// Thread contract: reentrant.
double field_of_view_by_experience(double given_rad, const BearingGraph& graph);

/// Estimate of the detection range.
struct RangeBelief {
  double range_m = 0.0;
  double doubt = 0.0;  ///< see Scene::range_doubt
};
/// The detection range learned from the distances at which `landmarks` were seen and were missed, from shortly before
/// their first to shortly after their last bearing (mathematics VI.20). Without landmarks that come into or go out of
/// range, the range and its doubt stay as given: a robot in a small room cannot learn the range. Thread contract:
/// reentrant.
RangeBelief range_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks);

/// The scene with the learned field of view and range. Through a narrow view, landmarks come and go at the edges of the
/// view, and the range stays as given.
Scene scene_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks);

}  // namespace azimuth
