#pragma once
#include <vector>

#include "tools/plot/axes.hpp"
#include "tools/plot/canvas.hpp"
#include "tools/plot/label_space.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

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
