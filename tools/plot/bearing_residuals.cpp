#include "tools/plot/bearing_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "slam/geometry/angle.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/map_layers.hpp"

namespace azimuth {
namespace {

constexpr double kMost_sigmas = 5.0, kBin_sigmas = 0.25;
constexpr double kMost_deg = 180.0, kBin_deg = 15.0;
constexpr std::size_t kFewestForMedian = 5, kMostDots = 2000;
constexpr double kDotWidth_px = 4.0, kDotLength_px = 0.1, kResidualLine_px = 3.0, kNormalDash_px = 9.0;
// Points that are not finite interrupt a line.
const Eigen::Vector2d kGap = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

using Residuals = std::vector<PlottedResidual>;

double normal_density(double sigmas) { return std::exp(-0.5 * sigmas * sigmas) / std::sqrt(2.0 * kPi); }

/// The outline of the histogram. Its area is the share of the residuals that lie inside the diagram.
PlotLine histogram(const Residuals& residuals) {
  std::vector<double> counts(static_cast<std::size_t>(std::lround(2.0 * kMost_sigmas / kBin_sigmas)));
  for (const PlottedResidual& residual : residuals) {
    const double bin = std::floor((residual.sigmas + kMost_sigmas) / kBin_sigmas);
    if (bin >= 0.0 && bin < static_cast<double>(counts.size())) ++counts[static_cast<std::size_t>(bin)];
  }
  const double per_count = 1.0 / (kBin_sigmas * static_cast<double>(std::max<std::size_t>(1, residuals.size())));
  PlotLine outline{{-kMost_sigmas, 0.0}};
  for (std::size_t bin = 0; bin < counts.size(); ++bin)
    for (const double side : {0.0, 1.0})
      outline.emplace_back(-kMost_sigmas + kBin_sigmas * (static_cast<double>(bin) + side), per_count * counts[bin]);
  outline.emplace_back(kMost_sigmas, 0.0);
  return outline;
}

PlotLine normal_curve() {
  PlotLine curve;
  for (double sigmas = -kMost_sigmas; sigmas <= kMost_sigmas; sigmas += 0.1)
    curve.emplace_back(sigmas, normal_density(sigmas));
  return curve;
}

double highest(const PlotLine& line) {
  return std::ranges::max(line, {}, [](const Eigen::Vector2d& point) { return point.y(); }).y();
}

/// The medians over sectors of azimuth, with a gap where hardly anything was seen.
PlotLine medians(const Residuals& residuals) {
  std::vector<std::vector<double>> sectors(static_cast<std::size_t>(std::lround(2.0 * kMost_deg / kBin_deg)));
  for (const PlottedResidual& residual : residuals) {
    const double sector = (rad_to_degrees(wrap(residual.azimuth_rad)) + kMost_deg) / kBin_deg;
    sectors[std::min(sectors.size() - 1, static_cast<std::size_t>(sector))].push_back(residual.sigmas);
  }
  PlotLine line;
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    std::vector<double>& sector = sectors[i];
    const auto middle = sector.begin() + static_cast<std::ptrdiff_t>(sector.size() / 2);
    std::ranges::nth_element(sector, middle);
    line.push_back(sector.size() < kFewestForMedian
                       ? kGap
                       : Eigen::Vector2d{-kMost_deg + kBin_deg * (static_cast<double>(i) + 0.5), *middle});
  }
  return line;
}

/// One diagram, which is clipped to its frame.
class Diagram {
 public:
  Diagram(PlotCanvas& canvas, const DiagramAxis& x, const DiagramAxis& y, const Box& frame_px)
      : canvas_(canvas), axes_(x, y, frame_px) {
    axes_.draw(canvas_);
    canvas_.clip(frame_px.low, frame_px.high - frame_px.low);
  }
  Diagram(const Diagram&) = delete;
  Diagram& operator=(const Diagram&) = delete;
  ~Diagram() { canvas_.release_clip(); }

  void line(const PlotLine& points, const Colour& colour) { canvas_.line(on_canvas(points), colour, kResidualLine_px); }
  void dashed_line(const PlotLine& points, const Colour& colour) {
    canvas_.dashed_line(on_canvas(points), colour, kResidualLine_px, kNormalDash_px);
  }
  void area(const PlotLine& outline, const Colour& colour) {
    canvas_.polygon(on_canvas(outline), colour.with_alpha(0.15), colour, kResidualLine_px);
  }
  /// Dots are one line of very short pieces, which takes a tenth of the bytes of discs.
  void dots(const Residuals& residuals, const Colour& colour) {
    PlotLine pieces;
    const std::size_t every = 1 + residuals.size() / kMostDots;
    for (std::size_t i = 0; i < residuals.size(); i += every) {
      const Eigen::Vector2d at = axes_.to_px({rad_to_degrees(wrap(residuals[i].azimuth_rad)), residuals[i].sigmas});
      if (axes_.frame_px().contains(at))
        pieces.insert(pieces.end(), {at, at + Eigen::Vector2d{kDotLength_px, 0.0}, kGap});
    }
    canvas_.line(pieces, colour, kDotWidth_px);
  }

 private:
  PlotLine on_canvas(PlotLine points) const {
    for (Eigen::Vector2d& point : points) point = axes_.to_px(point);
    return points;
  }

  PlotCanvas& canvas_;
  Axes axes_;
};

std::string words(const char* name, const Residuals& residuals) {
  return fmt::format("{}: {:.0f} % within 2\u03c3, {:.0f} % beyond {:.0f}\u03c3", name,
                     100.0 * share_within(residuals, 2.0), 100.0 * (1.0 - share_within(residuals, kMost_sigmas)),
                     kMost_sigmas);
}

}  // namespace

double share_within(const std::vector<PlottedResidual>& residuals, double most) {
  const auto within =
      std::ranges::count_if(residuals, [&](const PlottedResidual& each) { return std::abs(each.sigmas) <= most; });
  return residuals.empty() ? 0.0 : static_cast<double>(within) / static_cast<double>(residuals.size());
}

PlotCanvas drawn_residuals(const BearingResiduals& residuals, PlotFormat format) {
  const Eigen::Vector2d left_px{110.0, 170.0}, right_px{890.0, 170.0}, size_px{670.0, 450.0};
  PlotCanvas canvas(1600, 710, kPaperColour, format);
  canvas.text(residuals.title, {left_px.x(), 56.0}, {34.0, kInkColour, true, Anchor::left});
  Legend(canvas,
         {line_entry(words("before", residuals.before), kOdometryColour, kResidualLine_px),
          line_entry(words("after", residuals.after), kCalibratedColour, kResidualLine_px),
          line_entry("standard normal: 95 % within 2\u03c3", kInkColour, kResidualLine_px, kNormalDash_px)},
         1450.0)
      .draw(canvas, {left_px.x(), 84.0});
  const PlotLine before = histogram(residuals.before), after = histogram(residuals.after);
  {
    const double high = 1.1 * std::max({highest(before), highest(after), normal_density(0.0)});
    Diagram diagram(canvas, {"residual (\u03c3)", -kMost_sigmas, kMost_sigmas, 1.0},
                    {"density", 0.0, high, tick_step(high, 6)}, {left_px, left_px + size_px});
    diagram.area(after, kCalibratedColour);
    diagram.line(before, kOdometryColour);
    diagram.dashed_line(normal_curve(), kInkColour);
  }
  Diagram diagram(canvas, {"azimuth from the heading (degrees), left is positive", -kMost_deg, kMost_deg, 45.0},
                  {"residual (\u03c3)", -kMost_sigmas, kMost_sigmas, 1.0}, {right_px, right_px + size_px});
  diagram.dots(residuals.before, kOdometryColour.with_alpha(0.45));
  diagram.dots(residuals.after, kCalibratedColour.with_alpha(0.45));
  diagram.line(medians(residuals.before), kOdometryColour);
  diagram.line(medians(residuals.after), kCalibratedColour);
  return canvas;
}

}  // namespace azimuth
