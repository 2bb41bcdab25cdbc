#include "slam/camera/pajdla_fisheye.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"

namespace azimuth {

namespace {

/// Solves radius_at_px(theta) = radius_px for theta in [0, theta_max], where the radius grows strictly. A Newton step
/// that leaves the bracket is replaced by bisection.
double theta_at(const PajdlaFisheye& fisheye, double radius_px) {
  double low = 0.0, high = fisheye.theta_max_rad;
  double theta = radius_px / fisheye.radius_slope_px_per_rad(0.0);
  for (int i = 0; i < 100; ++i) {
    if (!(theta >= low && theta <= high)) theta = 0.5 * (low + high);
    const double excess_px = fisheye.radius_at_px(theta) - radius_px;
    if (excess_px == 0.0) return theta;
    (excess_px > 0.0 ? high : low) = theta;
    const double next = theta - excess_px / fisheye.radius_slope_px_per_rad(theta);
    if (std::abs(next - theta) <= 2.0 * std::numeric_limits<double>::epsilon()) return std::clamp(next, low, high);
    theta = next;
  }
  return theta;
}

}  // namespace

double PajdlaFisheye::radius_at_px(double theta_rad) const {
  return a_px * std::tan(theta_rad / b) + c_px * std::sin(theta_rad / d);
}

double PajdlaFisheye::radius_slope_px_per_rad(double theta_rad) const {
  const double cos_b = std::cos(theta_rad / b);
  return a_px / (b * cos_b * cos_b) + c_px / d * std::cos(theta_rad / d);
}

std::optional<std::string_view> PajdlaFisheye::problem() const {
  if (!(theta_max_rad > 0.0 && theta_max_rad <= kPi)) return "theta_max must be above 0 and at most pi";
  if (!(b > 0.0 && d > 0.0)) return "b and d must be positive";
  if (!(theta_max_rad / b < kPi / 2.0)) return "tan(theta / b) must have no pole up to theta_max";
  constexpr int kSteps = 512;
  for (int i = 0; i <= kSteps; ++i) {
    const double slope = radius_slope_px_per_rad(theta_max_rad * i / kSteps);
    if (!(slope > 0.0 && std::isfinite(slope))) return "the radius must grow strictly up to theta_max";
  }
  return std::nullopt;
}

std::optional<ElevationAt> PajdlaFisheye::elevation_at(double radius_px) const {
  if (!(radius_px >= 0.0 && radius_px <= radius_at_px(theta_max_rad))) return std::nullopt;
  const double theta = theta_at(*this, radius_px);
  return ElevationAt{kPi / 2.0 - theta, -1.0 / radius_slope_px_per_rad(theta)};
}

std::optional<double> PajdlaFisheye::radius_px(double elevation_rad) const {
  const double theta = kPi / 2.0 - elevation_rad;
  if (!(theta >= 0.0 && theta <= theta_max_rad)) return std::nullopt;
  return radius_at_px(theta);
}

}  // namespace azimuth
