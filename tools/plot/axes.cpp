#include "tools/plot/axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

constexpr Colour kGrid{0.90, 0.91, 0.92};
constexpr Colour kFrame{0.55, 0.57, 0.60};
constexpr Colour kLabel{0.30, 0.32, 0.35};

/// The value with as many decimals as the step needs, without "-0".
std::string label(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", std::abs(value) < step / 2 ? 0.0 : value, decimals);
}

}  // namespace

Axes::Axes(const Extent& shown, const Eigen::Vector2d& top_left_px, double width_px, double min_height_px,
           double max_height_px)
    : top_left_px_(top_left_px), size_px_(width_px, 0.0) {
  const Eigen::Vector2d size_m = shown.size_m().cwiseMax(1e-3);
  size_px_.y() = std::clamp(width_px * size_m.y() / size_m.x(), min_height_px, max_height_px);
  scale_px_per_m_.setConstant(size_px_.cwiseQuotient(size_m).minCoeff());
  const Eigen::Vector2d centre_m = (shown.low_m + shown.high_m) / 2,
                        half_m = size_px_.cwiseQuotient(scale_px_per_m_) / 2;
  shown_ = {centre_m - half_m, centre_m + half_m, false};
  constexpr double kPxPerTick = 90.0;
  const int most = std::max(3, static_cast<int>(size_px_.minCoeff() / kPxPerTick));
  // Both axes have the same step, so that the grid consists of squares.
  step_.setConstant(tick_step(shown_.size_m().minCoeff(), most));
}

Axes::Axes(const DiagramAxis& x, const DiagramAxis& y, const Box& frame_px)
    : top_left_px_(frame_px.low),
      size_px_(frame_px.high - frame_px.low),
      scale_px_per_m_(size_px_.cwiseQuotient(Eigen::Vector2d{x.high - x.low, y.high - y.low})),
      shown_{{x.low, y.low}, {x.high, y.high}, false},
      x_name_(x.name),
      y_name_(y.name),
      step_(x.step, y.step) {}

Eigen::Vector2d Axes::to_px(const Eigen::Vector2d& p_map_m) const {
  return top_left_px_ +
         scale_px_per_m_.cwiseProduct(Eigen::Vector2d{p_map_m.x() - shown_.low_m.x(), shown_.high_m.y() - p_map_m.y()});
}

void Axes::draw(PlotCanvas& canvas) const {
  const Eigen::Vector2d end = top_left_px_ + size_px_;
  const TextStyle style{19.0, kLabel, false, Anchor::centre};
  for (const double x_m : multiples(shown_.low_m.x(), shown_.high_m.x(), step_.x())) {
    const double x_px = to_px(Eigen::Vector2d{x_m, 0.0}).x();
    canvas.line(std::array<Eigen::Vector2d, 2>{{{x_px, top_left_px_.y()}, {x_px, end.y()}}}, kGrid, 1.2);
    canvas.text(label(x_m, step_.x()), {x_px, end.y() + 28.0}, style);
  }
  TextStyle beside = style;
  beside.anchor = Anchor::right;
  for (const double y_m : multiples(shown_.low_m.y(), shown_.high_m.y(), step_.y())) {
    const double y_px = to_px(Eigen::Vector2d{0.0, y_m}).y();
    canvas.line(std::array<Eigen::Vector2d, 2>{{{top_left_px_.x(), y_px}, {end.x(), y_px}}}, kGrid, 1.2);
    canvas.text(label(y_m, step_.y()), {top_left_px_.x() - 12.0, y_px + 7.0}, beside);
  }
  canvas.polygon(
      std::array<Eigen::Vector2d, 4>{{top_left_px_, {end.x(), top_left_px_.y()}, end, {top_left_px_.x(), end.y()}}},
      kFrame.with_alpha(0.0), kFrame, 1.5);
  canvas.text(x_name_, {(top_left_px_.x() + end.x()) / 2, end.y() + 60.0}, style);
  canvas.text(y_name_, {top_left_px_.x() - 62.0, (top_left_px_.y() + end.y()) / 2}, style, true);
}

void Extent::include(const Eigen::Vector2d& point_m) {
  if (!point_m.allFinite()) return;
  low_m = empty ? point_m : Eigen::Vector2d(low_m.cwiseMin(point_m));
  high_m = empty ? point_m : Eigen::Vector2d(high_m.cwiseMax(point_m));
  empty = false;
}

void Extent::include(std::span<const Eigen::Vector2d> points_m) {
  for (const Eigen::Vector2d& point_m : points_m) include(point_m);
}

Extent Extent::padded(double margin_m) const {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return {low_m - margin, high_m + margin, empty};
}

Extent Extent::stretched(const Extent& other, double limit_m) const {
  if (other.empty) return *this;
  if (empty) return other;
  const Extent limit = padded(limit_m);
  Extent result = *this;
  result.include(Eigen::Vector2d(other.low_m.cwiseMax(limit.low_m).cwiseMin(limit.high_m)));
  result.include(Eigen::Vector2d(other.high_m.cwiseMax(limit.low_m).cwiseMin(limit.high_m)));
  return result;
}

double tick_step(double length, int most) {
  if (!(length > 0.0)) return 1.0;
  const double least = length / most;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double nice : {1.0, 2.0, 5.0})
    if (nice * decade >= least) return nice * decade;
  return 10.0 * decade;
}

std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> result;
  const double last = std::floor(high / step);
  for (double k = std::ceil(low / step); k <= last; ++k) result.push_back(k * step);
  return result;
}

}  // namespace azimuth
