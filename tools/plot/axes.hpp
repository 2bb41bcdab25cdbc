#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"
#include "tools/plot/clip.hpp"

namespace azimuth {

/// A bounding box in metres, empty until the first point. Points that are not finite are ignored.
struct Extent {
  Eigen::Vector2d low_m{0.0, 0.0};
  Eigen::Vector2d high_m{0.0, 0.0};
  bool empty = true;

  void include(const Eigen::Vector2d& point_m);
  void include(std::span<const Eigen::Vector2d> points_m);
  Eigen::Vector2d size_m() const { return high_m - low_m; }
  /// The box enlarged by `margin_m` on each side.
  Extent padded(double margin_m) const;
  /// The box enlarged to include `other`, but by at most `limit_m` on each side, so that outliers do not make the rest
  /// tiny.
  Extent stretched(const Extent& other, double limit_m) const;
};

/// The smallest of 1, 2 or 5 times a power of ten that divides `length` into at most `most` steps.
double tick_step(double length, int most);

/// The multiples of `step` from `low` to `high`.
std::vector<double> multiples(double low, double high, double step);

/// One axis of a diagram: its name, its range, and the step of its grid lines.
struct DiagramAxis {
  std::string name;
  double low = 0.0, high = 1.0, step = 1.0;
};

/// Maps map coordinates to the canvas: x to the right, y upwards, the same scale for both. A diagram has two scales.
class Axes {
 public:
  /// Fits `shown` into a frame of width `width_px` at `top_left_px`. The height of the frame follows from the shape of
  /// `shown`, between `min_height_px` and `max_height_px`. In one direction the frame may show more than `shown`.
  Axes(const Extent& shown, const Eigen::Vector2d& top_left_px, double width_px, double min_height_px,
       double max_height_px);
  /// Axes of two quantities other than metres, which fill the frame.
  Axes(const DiagramAxis& x, const DiagramAxis& y, const Box& frame_px);

  Eigen::Vector2d to_px(const Eigen::Vector2d& p_map_m) const;
  double to_px(double length_m) const { return length_m * scale_px_per_m_.x(); }
  const Eigen::Vector2d& top_left_px() const { return top_left_px_; }
  const Eigen::Vector2d& size_px() const { return size_px_; }
  Box frame_px() const { return {top_left_px_, top_left_px_ + size_px_}; }
  /// The part of the map that the frame shows [m].
  Box shown_m() const { return {shown_.low_m, shown_.high_m}; }

  /// Draws grid lines, frame, tick labels and axis names.
  void draw(PlotCanvas& canvas) const;

 private:
  Eigen::Vector2d top_left_px_, size_px_, scale_px_per_m_;
  Extent shown_;
  std::string x_name_ = "x (m)", y_name_ = "y (m)";
  Eigen::Vector2d step_;  // between grid lines
};

}  // namespace azimuth
