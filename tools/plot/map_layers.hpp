#pragma once
// Internal to tools/plot: the layers of a map, and the appearance of its elements, also in the legend.

#include <Eigen/Core>
#include <vector>

#include "tools/plot/axes.hpp"
#include "tools/plot/canvas.hpp"
#include "tools/plot/label_space.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

// Colours of Okabe and Ito, which stay distinct for every kind of colour vision. Truth is grey to be less prominent.
inline constexpr Colour kPaperColour{1.0, 1.0, 1.0};
inline constexpr Colour kInkColour{0.13, 0.14, 0.16};
inline constexpr Colour kFaintColour{0.40, 0.42, 0.45};
inline constexpr Colour kNameColour{0.25, 0.27, 0.30};
inline constexpr Colour kEstimateColour{0.0, 0.447, 0.698};
inline constexpr Colour kOdometryColour{0.835, 0.369, 0.0};
inline constexpr Colour kCalibratedColour{0.0, 0.62, 0.451};
inline constexpr Colour kSmoothedColour{0.8, 0.475, 0.655};
inline constexpr Colour kTruthColour{0.74, 0.76, 0.78};

inline constexpr double kTruthWidth_px = 9.0, kOdometryWidth_px = 2.0, kEstimateWidth_px = 2.6, kLostWidth_px = 1.6;
inline constexpr double kSmoothedWidth_px = 2.0;
inline constexpr double kLostDash_px = 9.0, kSmoothedDash_px = 14.0;
inline constexpr double kPlusRadius_px = 9.0, kRobotRadius_px = 22.0;

LandmarkStyle style_of(const MapPicture& picture, const PlottedLandmark& landmark);

/// The symbol of a true landmark.
void draw_plus(PlotCanvas& canvas, const Eigen::Vector2d& at_px);
/// The symbol of a landmark whose distance is hardly known.
void draw_hardly_known(PlotCanvas& canvas, const Eigen::Vector2d& at_px);
void draw_start(PlotCanvas& canvas, const Eigen::Vector2d& at_px);
/// An arrow head in the robot's heading. `direction` is in pixels, so y points down.
void draw_robot(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const Eigen::Vector2d& direction);

/// Draws the map inside its axes, from back to front.
///
/// Thread contract: thread-bound.
class MapLayers {
 public:
  /// Borrows all arguments.
  MapLayers(PlotCanvas& canvas, const Axes& axes, const MapPicture& picture);

  void draw();

 private:
  PlotLine to_px(const PlotLine& line_m) const;
  void draw_line(const PlotLine& line_m, const Colour& colour, double width_px, double dash_px = 0.0);
  void draw_ellipse(const UncertainPoint& point, const Colour& fill, const Colour& edge, double width_px);
  void draw_estimate();
  void draw_landmarks();
  void draw_ends();
  void write_names();
  void take_landmarks(LabelSpace& space) const;
  bool is_shown(const Eigen::Vector2d& p_map_m) const { return axes_.shown_m().contains(p_map_m); }

  PlotCanvas& canvas_;
  const Axes& axes_;
  const MapPicture& picture_;
  double view_m_;
};

/// One legend entry for each kind of element that MapLayers draws in `shown_m`.
std::vector<LegendEntry> legend_entries(const MapPicture& picture, const Box& shown_m);

}  // namespace azimuth
