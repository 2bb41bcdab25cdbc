#include "tools/plot/legend.hpp"

#include <utility>

namespace azimuth {
namespace {

constexpr Colour kInk{0.13, 0.14, 0.16};
constexpr double kSymbol_px = 44.0, kGap_px = 10.0, kBetween_px = 30.0;
const TextStyle kStyle{20.0, kInk, false, Anchor::left};

}  // namespace

std::vector<RowPlace> flow(std::span<const double> widths_px, double row_px) {
  std::vector<RowPlace> places;
  RowPlace next;
  for (const double width_px : widths_px) {
    if (next.left_px > 0.0 && next.left_px + width_px > row_px) next = {next.row + 1, 0.0};
    places.push_back(next);
    next.left_px += width_px;
  }
  return places;
}

Legend::Legend(PlotCanvas& canvas, std::vector<LegendEntry> entries, double width_px) : entries_(std::move(entries)) {
  std::vector<double> widths_px;
  for (const LegendEntry& entry : entries_)
    widths_px.push_back(kSymbol_px + kGap_px + canvas.text_width_px(entry.words, kStyle) + kBetween_px);
  for (const RowPlace& place : flow(widths_px, width_px + kBetween_px)) {
    at_px_.emplace_back(place.left_px, kLegendRow_px * static_cast<double>(place.row));
    rows_ = place.row + 1;
  }
}

void Legend::draw(PlotCanvas& canvas, const Eigen::Vector2d& top_left_px) const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Eigen::Vector2d base_px = top_left_px + at_px_[i] + Eigen::Vector2d{0.0, 24.0};
    entries_[i].symbol(canvas, base_px + Eigen::Vector2d{kSymbol_px / 2, -7.0});
    canvas.text(entries_[i].words, base_px + Eigen::Vector2d{kSymbol_px + kGap_px, 0.0}, kStyle);
  }
}

}  // namespace azimuth
