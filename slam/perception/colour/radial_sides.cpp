#include "slam/perception/colour/radial_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kShortest = 4.0;   // samples along the radius
constexpr std::size_t kFewest = 4;  // points of a side
/// A side's points do not err independently: the steps of a slanted edge repeat every few samples.
constexpr double kCorrelated = 4.0;

double cross(const CentredPoint& a, const CentredPoint& b) { return a.x() * b.y() - a.y() * b.x(); }

bool is_less_than_part(std::size_t count, double part, std::size_t all) {
  return static_cast<double>(count) < part * static_cast<double>(all);
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
                      .sigma_rad = std::hypot(0.5 * std::sqrt(left->variance + right->variance),
                                              settings_.sigma_centre_px / halfway_px),
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

/// The outermost point on the side of `sign` for each sample along the radius.
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

/// Those near the line of the median direction.
void RadialSides::keep_straight(std::vector<SidePoint>& side) {
  slopes_.clear();
  for (const SidePoint& point : side) slopes_.push_back(point.aside_px / point.along_px);
  const double middle = median(slopes_);
  std::erase_if(side,
                [&](const SidePoint& point) { return std::abs(point.off_px(middle)) > settings_.straight_within_px; });
}

/* The line through the centre with the least squared lateral error: slope = sum(along aside) / sum(along^2), its
 * variance that of one point over sum(along^2), and what displaces all points alike.
 */
RadialSides::Side RadialSides::least_squares(const std::vector<SidePoint>& side) const {
  double mixed = 0.0, squared = 0.0, errors = 0.0;
  for (const SidePoint& point : side) {
    mixed += point.along_px * point.aside_px;
    squared += point.along_px * point.along_px;
  }
  const double slope = mixed / squared;
  for (const SidePoint& point : side) errors += point.off_px(slope) * point.off_px(slope);
  const auto count = static_cast<double>(side.size());
  const double variance_px2 = kCorrelated * errors / (count - 1.0);
  const double common_px2 = std::pow(settings_.sigma_side_px * sample_px_, 2);
  return {slope, (variance_px2 + count * common_px2) / squared};
}

}  // namespace azimuth
