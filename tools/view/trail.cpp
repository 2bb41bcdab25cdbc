#include "tools/view/trail.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// True if two points have at least the spacing in position, heading or time. A standing robot gets occasional points.
bool Trail::is_apart(const TrailPoint& from, const TrailPoint& to) const {
  return std::hypot(to.T_map_body.x_m - from.T_map_body.x_m, to.T_map_body.y_m - from.T_map_body.y_m) >= apart_m_ ||
         std::abs(wrap(to.T_map_body.heading_rad - from.T_map_body.heading_rad)) >= apart_rad_ ||
         to.t_s - from.t_s >= apart_s_ || to.health != from.health;
}

void Trail::add(const TrailPoint& point) {
  if (!points_.empty() && point.t_s <= points_.back().t_s) {
    points_.insert(std::ranges::upper_bound(points_, point.t_s, {}, &TrailPoint::t_s), point);
  } else if (points_.size() >= 2 && !is_apart(points_[points_.size() - 2], point)) {
    points_.back() = point;
  } else {
    points_.push_back(point);
  }
  if (points_.size() > most_) thin();
}

void Trail::thin() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (i % 2 == 0 || i + 1 == points_.size()) points_[kept++] = points_[i];
  points_.resize(kept);
  apart_m_ *= 2.0;
  apart_rad_ *= 2.0;
  apart_s_ *= 2.0;
}

void Trail::clear() { *this = Trail(most_); }

std::span<const TrailPoint> Trail::after(double t_s, std::size_t count) const {
  const auto begin = std::ranges::upper_bound(points_, t_s, {}, &TrailPoint::t_s);
  const auto left = static_cast<std::size_t>(points_.end() - begin);
  return {begin, std::min(left, count)};
}

}  // namespace azimuth
