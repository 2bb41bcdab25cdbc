#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

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

}  // namespace azimuth
