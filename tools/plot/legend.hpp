#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace azimuth {

/// A symbol and its explanation.
struct LegendEntry {
  std::string words;
  std::function<void(PlotCanvas& canvas, const Eigen::Vector2d& centre_px)> symbol;
};

/// The entry of a line; `dash_px` 0: a line without dashes.
LegendEntry line_entry(const std::string& words, const Colour& colour, double width_px, double dash_px = 0.0);

inline constexpr double kLegendRow_px = 34.0;

/// A legend whose entries are arranged in rows from left to right.
///
/// Thread contract: thread-bound.
class Legend {
 public:
  /// Measures the text on `canvas`, which may be another one than the one for draw().
  Legend(PlotCanvas& canvas, std::vector<LegendEntry> entries, double width_px);

  double height_px() const { return kLegendRow_px * static_cast<double>(rows_); }
  void draw(PlotCanvas& canvas, const Eigen::Vector2d& top_left_px) const;

 private:
  std::vector<LegendEntry> entries_;
  std::vector<Eigen::Vector2d> at_px_;
  std::size_t rows_ = 0;
};

/// Row and left end of an item. flow() arranges items of the given widths side by side and begins a new row if the next
/// item does not fit. An item wider than a row gets its own row.
struct RowPlace {
  std::size_t row = 0;
  double left_px = 0.0;
};
std::vector<RowPlace> flow(std::span<const double> widths_px, double row_px);

}  // namespace azimuth
