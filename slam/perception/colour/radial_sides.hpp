#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/outline.hpp"

namespace azimuth {

/// An upright thing as its two sides show it. Angles from u towards v.
struct UprightShape {
  double angle_rad = 0.0;  ///< of the line midway between the sides
  double sigma_rad = 0.0;  ///< standard deviation of that, if the image's centre is where it is said to be
  double radius_px = 0.0;  ///< where the angle holds if it is not
  double length_px = 0.0;  ///< along the radius
  double width_px = 0.0;   ///< across, halfway along
};

/// Finds the two sides of an upright thing. The sides of anything upright are lines through the centre of an
/// omnidirectional image, so each tells its direction by itself: parts of it that are hidden, or merged with something
/// else, can be told from the rest and left out. The centre need not be known exactly: the lines may miss it a little.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the largest outline.
class RadialSides {
 public:
  explicit RadialSides(const ColourSettings& settings) : settings_(settings) {}

  /// Whether a point just outside of the outline could be background.
  using IsBackground = std::function<bool(const CentredPoint&)>;

  /// From an outline, which is exact to `sample_px`, and the angle of a line near its middle. Nothing when it does not
  /// have two free, straight sides.
  std::optional<UprightShape> find(std::span<const CentredPoint> outline, double near_rad, double sample_px,
                                   const IsBackground& is_background);

 private:
  struct SidePoint {
    double along_px = 0.0, aside_px = 0.0;  ///< from the centre along the line; from the line, towards greater angles
  };
  /// A line that may miss the centre: aside = offset + slope along.
  struct Line {
    double offset_px = 0.0;
    double slope = 0.0;

    double off_px(const SidePoint& point) const { return point.aside_px - offset_px - slope * point.along_px; }
  };
  struct Side {
    double slope = 0.0;      ///< of the line through the centre
    double variance = 0.0;   ///< of the slope
    double radius_px = 0.0;  ///< where that line meets the side
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
  std::vector<SidePoint> left_, right_;  // the outermost point in each sample along the radius
};

}  // namespace azimuth
