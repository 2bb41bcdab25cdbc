#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace azimuth {

/// Words beside the symbol that they explain.
struct LegendEntry {
  std::string words;
  std::function<void(PlotCanvas& canvas, const Eigen::Vector2d& centre_px)> symbol;
};

inline constexpr double kLegendRow_px = 34.0;

/// A legend laid out in rows from left to right.
///
/// Thread contract: thread-bound.
class Legend {
 public:
  /// Measures the words on `canvas`, which may be another one than is drawn on.
  Legend(PlotCanvas& canvas, std::vector<LegendEntry> entries, double width_px);

  double height_px() const { return kLegendRow_px * static_cast<double>(rows_); }
  void draw(PlotCanvas& canvas, const Eigen::Vector2d& top_left_px) const;

 private:
  std::vector<LegendEntry> entries_;
  std::vector<Eigen::Vector2d> at_px_;
  std::size_t rows_ = 0;
};

/// Row and left end of things of these widths set one beside the other, a new row being begun where the next does not
/// fit; one that is wider than a row has a row to itself.
struct RowPlace {
  std::size_t row = 0;
  double left_px = 0.0;
};
std::vector<RowPlace> flow(std::span<const double> widths_px, double row_px);

}  // namespace azimuth
