#include "tools/plot/legend.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

#include "tools/plot/map_layers.hpp"
#include "tools/plot/map_view.hpp"

namespace azimuth {
namespace {

/// Draws a horizontal ellipse as the legend symbol of a covariance.
void draw_oval(PlotCanvas& canvas, const Eigen::Vector2d& centre_px, const Colour& fill, const Colour& edge,
               double width_px) {
  const UncertainPoint oval{centre_px, Eigen::Vector2d(81.0, 20.0).asDiagonal()};
  canvas.polygon(ellipse_outline_m(oval), fill, edge, width_px);
}

LegendEntry landmark_entry(const std::string& words, const LandmarkStyle& style) {
  return {words, [style](PlotCanvas& canvas, const Eigen::Vector2d& centre_px) {
            draw_oval(canvas, centre_px, style.colour.with_alpha(0.22), style.colour, 2.0);
            draw_marker(canvas, centre_px, style);
          }};
}

void add_paths(const MapPicture& picture, std::vector<LegendEntry>& entries) {
  const auto any = [&](bool lost) {
    return std::ranges::any_of(picture.estimate, [lost](const PathPiece& piece) { return piece.lost == lost; });
  };
  if (any(false)) entries.push_back(line_entry("estimated path", kEstimateColour, kEstimateWidth_px));
  if (any(true)) entries.push_back(line_entry("while lost", kEstimateColour, kLostWidth_px, kLostDash_px));
  if (!picture.smoothed.empty())
    entries.push_back(line_entry("path in hindsight", kSmoothedColour, kSmoothedWidth_px, kSmoothedDash_px));
  if (!picture.poses.empty())
    entries.push_back({"position, 2\u03c3", [](PlotCanvas& canvas, const Eigen::Vector2d& centre_px) {
                         draw_oval(canvas, centre_px, kEstimateColour.with_alpha(0.10),
                                   kEstimateColour.with_alpha(0.55), 1.2);
                       }});
  if (!picture.truth.empty()) entries.push_back(line_entry("true path", kTruthColour, kTruthWidth_px));
  if (!picture.odometry.empty())
    entries.push_back(line_entry("wheel odometry alone", kOdometryColour, kOdometryWidth_px));
  if (!picture.calibrated.empty())
    entries.push_back(line_entry("wheel odometry, calibrated", kCalibratedColour, kOdometryWidth_px));
}

void add_landmarks(const MapPicture& picture, const Box& shown_m, std::vector<LegendEntry>& entries) {
  const double view_m = (shown_m.high - shown_m.low).minCoeff();
  const auto count = [&](auto&& chosen) {
    return std::ranges::count_if(picture.landmarks, [&](const PlottedLandmark& landmark) {
      return shown_m.contains(landmark.point.p_map_m) && chosen(landmark);
    });
  };
  const auto known_of = [&](int kind) {
    return count(
        [=](const PlottedLandmark& landmark) { return is_well_known(landmark, view_m) && landmark.kind == kind; });
  };
  const std::string& word = picture.landmark_word;
  if (const auto plain = known_of(-1); plain > 0)
    entries.push_back(landmark_entry(fmt::format("{}, 2\u03c3 ({})", word, plain), plain_landmark_style()));
  for (std::size_t kind = 0; kind < picture.kinds.size(); ++kind)
    if (const auto known = known_of(static_cast<int>(kind)); known > 0)
      entries.push_back(landmark_entry(fmt::format("{} {}, 2\u03c3 ({})", picture.kinds[kind].name, word, known),
                                       landmark_style(picture.kinds[kind], kind)));
  const auto vague = count([&](const PlottedLandmark& landmark) { return !is_well_known(landmark, view_m); });
  if (vague > 0) entries.push_back({fmt::format("{}, hardly known yet ({})", word, vague), draw_hardly_known});
}

constexpr Colour kInk{0.13, 0.14, 0.16};
constexpr double kSymbol_px = 44.0, kGap_px = 10.0, kBetween_px = 30.0;
const TextStyle kStyle{20.0, kInk, false, Anchor::left};

}  // namespace

LegendEntry line_entry(const std::string& words, const Colour& colour, double width_px, double dash_px) {
  return {words, [=](PlotCanvas& canvas, const Eigen::Vector2d& centre_px) {
            const Eigen::Vector2d half{20.0, 0.0};
            const std::array<Eigen::Vector2d, 2> ends{centre_px - half, centre_px + half};
            if (dash_px > 0.0)
              canvas.dashed_line(ends, colour, width_px, dash_px);
            else
              canvas.line(ends, colour, width_px);
          }};
}

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

std::vector<LegendEntry> legend_entries(const MapPicture& picture, const Box& shown_m) {
  std::vector<LegendEntry> entries;
  add_paths(picture, entries);
  add_landmarks(picture, shown_m, entries);
  if (!picture.true_landmarks.empty()) entries.push_back({picture.true_landmark_words, draw_plus});
  if (!picture.estimate.empty()) entries.push_back({"start", draw_start});
  if (picture.T_map_body)
    entries.push_back({"robot at the end", [](PlotCanvas& canvas, const Eigen::Vector2d& centre_px) {
                         draw_robot(canvas, centre_px, {1.0, 0.0});
                       }});
  return entries;
}

}  // namespace azimuth
