#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/outline.hpp"

namespace azimuth {

/// The shape of an upright object, measured by its two sides. Angles run from u towards v.
struct UprightShape {
  double angle_rad = 0.0;  ///< Angle of the line midway between the sides
  double sigma_rad = 0.0;  ///< Standard deviation of `angle_rad`, given an exact image centre
  double radius_px = 0.0;  ///< The radius at which `angle_rad` is right even if the image centre is slightly off
  double length_px = 0.0;  ///< Along the radius
  double width_px = 0.0;   ///< Across the radius, halfway along
};

/// Finds the two sides of an upright object. In an omnidirectional image the sides of an upright object are lines
/// through the centre, so each side tells its direction independently. Occluded parts of a side, and parts merged with
/// another object, can therefore be recognised and left out. The centre may be known inexactly: the lines may miss it a
/// little.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the largest outline.
class RadialSides {
 public:
  explicit RadialSides(const ColourSettings& settings) : settings_(settings) {}

  /// Whether a point just outside the outline can be background.
  using IsBackground = std::function<bool(const CentredPoint&)>;

  /// `outline` is exact to `sample_px`; `near_rad` is the angle of a line near its middle. Returns nullopt unless the
  /// outline has two free, straight sides.
  std::optional<UprightShape> find(std::span<const CentredPoint> outline, double near_rad, double sample_px,
                                   const IsBackground& is_background);

 private:
  struct SidePoint {
    /// along_px: distance from the centre along the line; aside_px: distance from the line, towards greater angles.
    double along_px = 0.0, aside_px = 0.0;
  };
  /// A line that may miss the centre: aside = offset + slope * along.
  struct Line {
    double offset_px = 0.0;
    double slope = 0.0;

    double off_px(const SidePoint& point) const { return point.aside_px - offset_px - slope * point.along_px; }
  };
  struct Side {
    double slope = 0.0;      ///< Slope of the line through the centre
    double variance = 0.0;   ///< Variance of the slope
    double radius_px = 0.0;  ///< The radius at which the line through the centre crosses the fitted side
  };

  bool measure_extent(std::span<const CentredPoint> outline);
  void collect(std::span<const CentredPoint> outline, std::vector<SidePoint>& side, int sign) const;
  std::optional<Side> fit(std::vector<SidePoint>& side, int sign, const IsBackground& is_background);
  void keep_free(std::vector<SidePoint>& side, int sign, const IsBackground& is_background) const;
  void keep_straight(std::vector<SidePoint>& side) const;
  Line line_of_most(const std::vector<SidePoint>& side) const;
  Line line_between(const SidePoint& a, const SidePoint& b) const;
  Side least_squares(const std::vector<SidePoint>& side) const;

  const ColourSettings settings_;
  CentredPoint direction_ = CentredPoint::UnitX();
  double sample_px_ = 1.0;
  double nearest_px_ = 0.0, farthest_px_ = 0.0;
  std::vector<SidePoint> left_, right_;  // The outermost point for each sample along the radius
};

}  // namespace azimuth
