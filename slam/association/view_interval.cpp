#include "slam/association/view_interval.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

// At a smaller distance from the ray's origin its direction is dominated by rounding.
constexpr double kSamePlace_m = 1e-9;

double direction(const Eigen::Vector2d& vector) { return std::atan2(vector.y(), vector.x()); }

}  // namespace

bool ViewInterval::contains(double direction_rad, double margin_rad) const {
  // Measured from the middle, so that both ends count even if the sweep is near pi and the widened ends overlap.
  const double middle_rad = start_rad + 0.5 * sweep_rad;
  return std::abs(wrap(direction_rad - middle_rad)) <= 0.5 * std::abs(sweep_rad) + margin_rad;
}

std::optional<ViewInterval> view_interval(const Eigen::Vector2d& p_map_before_m, double direction_before_rad,
                                          const Eigen::Vector2d& p_map_now_m, double max_distance_m) {
  // Points p_before + s u with 0 <= s <= R that are within R of p_now: s^2 + 2 B s + |q|^2 <= R^2.
  const Eigen::Vector2d u(std::cos(direction_before_rad), std::sin(direction_before_rad));
  const Eigen::Vector2d q = p_map_before_m - p_map_now_m;
  const double B = u.dot(q), discriminant = B * B - q.squaredNorm() + max_distance_m * max_distance_m;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double s_min = std::max(0.0, -B - root), s_max = std::min(max_distance_m, -B + root);
  if (s_max < s_min) return std::nullopt;
  const Eigen::Vector2d near = q + s_min * u, far = q + s_max * u;
  if (near.norm() < kSamePlace_m) return ViewInterval{wrap(direction(far)), 0.0};
  return ViewInterval{direction(near), std::atan2(near.x() * far.y() - near.y() * far.x(), near.dot(far))};
}

double view_margin_rad(double variance_before_rad2, double variance_now_rad2, double variance_turn_rad2) {
  return 3.0 * std::sqrt(variance_before_rad2 + variance_now_rad2 + variance_turn_rad2);
}

}  // namespace azimuth
