#include "slam/perception/colour/radial_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kShortest = 4.0;   // Samples along the radius
constexpr std::size_t kFewest = 4;  // Points of a side
/// The errors of a side's points are correlated: the steps of a slanted edge repeat every few samples.
constexpr double kCorrelated = 4.0;
constexpr std::size_t kTries = 16;  // Number of candidate lines

double cross(const CentredPoint& a, const CentredPoint& b) { return a.x() * b.y() - a.y() * b.x(); }

bool is_less_than_part(std::size_t count, double part, std::size_t all) {
  return static_cast<double>(count) < part * static_cast<double>(all);
}

}  // namespace

std::optional<UprightShape> RadialSides::find(std::span<const CentredPoint> outline, double near_rad, double sample_px,
                                              const IsBackground& is_background) {
  sample_px_ = sample_px;
  direction_ = {std::cos(near_rad), std::sin(near_rad)};
  if (!measure_extent(outline)) return std::nullopt;
  collect(outline, left_, 1);
  collect(outline, right_, -1);
  const std::optional<Side> left = fit(left_, 1, is_background);
  const std::optional<Side> right = left ? fit(right_, -1, is_background) : std::nullopt;
  if (!right || left->slope <= right->slope) return std::nullopt;

  const double halfway_px = 0.5 * (nearest_px_ + farthest_px_);
  return UprightShape{.angle_rad = wrap(near_rad + 0.5 * (std::atan(left->slope) + std::atan(right->slope))),
                      .sigma_rad = 0.5 * std::sqrt(left->variance + right->variance),
                      .radius_px = 2.0 / (1.0 / left->radius_px + 1.0 / right->radius_px),
                      .length_px = farthest_px_ - nearest_px_,
                      .width_px = halfway_px * (left->slope - right->slope)};
}

bool RadialSides::measure_extent(std::span<const CentredPoint> outline) {
  nearest_px_ = std::numeric_limits<double>::max();
  farthest_px_ = 0.0;
  for (const CentredPoint& point : outline) {
    const double along_px = direction_.dot(point);
    nearest_px_ = std::min(nearest_px_, along_px);
    farthest_px_ = std::max(farthest_px_, along_px);
  }
  return nearest_px_ >= 1.0 && farthest_px_ - nearest_px_ >= kShortest * sample_px_;
}

/// Collects, for each sample along the radius, the outermost point on the side of `sign`.
void RadialSides::collect(std::span<const CentredPoint> outline, std::vector<SidePoint>& side, int sign) const {
  constexpr double kNothing = -std::numeric_limits<double>::max();
  side.assign(static_cast<std::size_t>((farthest_px_ - nearest_px_) / sample_px_) + 1, {0.0, sign * kNothing});
  for (const CentredPoint& point : outline) {
    const SidePoint here{direction_.dot(point), cross(direction_, point)};
    SidePoint& outermost = side[static_cast<std::size_t>((here.along_px - nearest_px_) / sample_px_)];
    if (sign * here.aside_px > sign * outermost.aside_px) outermost = here;
  }
  std::erase_if(side, [](const SidePoint& point) { return point.along_px == 0.0; });
}

std::optional<RadialSides::Side> RadialSides::fit(std::vector<SidePoint>& side, int sign,
                                                  const IsBackground& is_background) {
  const std::size_t all = side.size();
  keep_free(side, sign, is_background);
  const std::size_t free = side.size();
  if (side.empty() || is_less_than_part(free, settings_.free_part_min, all)) return std::nullopt;
  keep_straight(side);
  if (side.size() < kFewest || is_less_than_part(side.size(), settings_.straightness_min, free)) return std::nullopt;
  return least_squares(side);
}

void RadialSides::keep_free(std::vector<SidePoint>& side, int sign, const IsBackground& is_background) const {
  const CentredPoint aside{-direction_.y(), direction_.x()};
  std::erase_if(side, [&](const SidePoint& point) {
    return !is_background(point.along_px * direction_ + (point.aside_px + sign * settings_.free_within_px) * aside);
  });
}

void RadialSides::keep_straight(std::vector<SidePoint>& side) const {
  const Line line = line_of_most(side);
  const double within_px = settings_.straight_within_px * sample_px_;
  std::erase_if(side, [&](const SidePoint& point) { return std::abs(line.off_px(point)) > within_px; });
}

/// Of the lines through two points each, returns the one with the most points near it.
RadialSides::Line RadialSides::line_of_most(const std::vector<SidePoint>& side) const {
  const double within_px = settings_.straight_within_px * sample_px_;
  const std::size_t half = side.size() / 2, step = std::max<std::size_t>(1, half / kTries);
  Line best;
  std::ptrdiff_t most = -1;
  for (std::size_t i = 0; i + half < side.size(); i += step) {
    const Line line = line_between(side[i], side[i + half]);
    const std::ptrdiff_t near =
        std::ranges::count_if(side, [&](const SidePoint& point) { return std::abs(line.off_px(point)) <= within_px; });
    if (near <= most) continue;
    most = near;
    best = line;
  }
  return best;
}

/// The line through both points. If it misses the centre by too much, returns the line through their midpoint that
/// misses the centre by the greatest permitted distance.
RadialSides::Line RadialSides::line_between(const SidePoint& a, const SidePoint& b) const {
  const double along_px = 0.5 * (a.along_px + b.along_px), aside_px = 0.5 * (a.aside_px + b.aside_px);
  const double reach_px = b.along_px - a.along_px, slope = reach_px > 0.0 ? (b.aside_px - a.aside_px) / reach_px : 0.0;
  const double off_px =
      std::clamp(aside_px - slope * along_px, -settings_.centre_within_px, settings_.centre_within_px);
  return {off_px, (aside_px - off_px) / along_px};
}

/* The line through the centre with the least sum of squared lateral errors: slope = sum(along aside) / sum(along^2). A
 * side that misses the centre crosses this line at the radius sum(along^2) / sum(along). The variance of the slope is
 * that of one point about the side's own line over sum(along^2), plus the effect of the displacement common to all
 * points.
 */
RadialSides::Side RadialSides::least_squares(const std::vector<SidePoint>& side) const {
  double along = 0.0, aside = 0.0, along2 = 0.0, aside2 = 0.0, mixed = 0.0;
  for (const SidePoint& point : side) {
    along += point.along_px;
    aside += point.aside_px;
    along2 += point.along_px * point.along_px;
    aside2 += point.aside_px * point.aside_px;
    mixed += point.along_px * point.aside_px;
  }
  const auto count = static_cast<double>(side.size());
  const double spread = along2 - along * along / count, leaning = mixed - along * aside / count;
  const double errors = std::max(0.0, aside2 - aside * aside / count - leaning * leaning / spread);
  const double variance_px2 = kCorrelated * errors / (count - 2.0);
  const double common_px2 = std::pow(settings_.sigma_side_px * sample_px_, 2);
  return {mixed / along2, (variance_px2 + count * common_px2) / along2, along2 / along};
}

}  // namespace azimuth
