#pragma once
#include "slam/smoother/smoother_settings.hpp"

namespace azimuth {

/// What a camera and a place give: how much is seen of what stands there, and how much of nothing.
struct Scene {
  double sigma_bearing_rad = 0.0262;             ///< of one azimuth, standard deviation
  double field_of_view_rad = 6.283185307179586;  ///< full angle about the heading; 2 pi: all round
  double range_m = 6.0;                          ///< how far landmarks are seen
  double range_doubt = 0.3;                      ///< as a share, by how much that may be more
  double detection_probability = 0.75;           ///< that one is seen which is in view and within range
  // Densities by angle, of the bearings of one image.
  double clutter_per_rad = 0.2;  ///< of those that are of nothing
  double new_per_rad = 0.4;      ///< of those that are of nothing mapped yet

  /// However well the range is known, how far away a landmark is may be uncertain, and some are seen from further off.
  static constexpr double kLeastRangeDoubt = 0.1;
  /// Landmarks further away than this are not asked after.
  double asked_within_m() const { return (1.0 + range_doubt) * range_m; }
  /// Those nearer than this should be seen: how far a camera sees is not known exactly.
  double surely_seen_within_m() const { return 0.9 * range_m; }
  bool sees_all_round() const;
  /// Through 140 degrees a landmark is in view for long enough to be found by several images, through 60 it is not.
  bool is_narrow() const { return field_of_view_rad < 1.75; }
  /// So many images show as much as one of a camera that sees all round.
  double images_for_all_round() const;
  /// A direction from the robot is in view.
  bool in_view(double azimuth_rad) const;
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// What a hypothesis is charged for, beside half the squares of its residuals: logarithms of odds (SPEC VI.20).
/// Natural.
struct HypothesisCosts {
  double unassigned = 0.0;  ///< for a bearing of nothing, against one that lies exactly where a landmark should be
  double landmark = 0.0;    ///< for having a landmark
  double missed = 0.0;      ///< for a landmark that is not seen where it should be
  friend bool operator==(const HypothesisCosts&, const HypothesisCosts&) = default;
};
HypothesisCosts hypothesis_costs(const Scene& scene, const SmootherSettings& smoother);

}  // namespace azimuth
