#include "slam/camera/polynomial_fisheye.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kFarthest_px = 1e5;  // No image is larger
constexpr int kSteps = 2048;

struct Value {
  double f = 0.0, slope = 0.0;
};

/// Horner's scheme for a polynomial and its derivative.
Value value_at(const PolynomialFisheye& fisheye, double radius_px) {
  Value value;
  for (std::size_t k = PolynomialFisheye::kCoefficients; k-- > 0;) {
    value.slope = value.slope * radius_px + value.f;
    value.f = value.f * radius_px + fisheye.a[k];
  }
  return value;
}

/// The first radius, in steps of 1/64 of the focal length, at which theta is at least `theta_rad`; nullopt if theta
/// stops growing before.
std::optional<double> bracket_px(const PolynomialFisheye& fisheye, double theta_rad) {
  const double step_px = -fisheye.a[0] / 64.0;
  for (int k = 1; k <= kSteps && k * step_px <= kFarthest_px; ++k) {
    const double radius_px = k * step_px;
    if (fisheye.theta_at_rad(radius_px) >= theta_rad) return radius_px;
    if (!(fisheye.theta_slope_rad_per_px(radius_px) > 0.0)) return std::nullopt;
  }
  return std::nullopt;
}

/// Solves theta_at_rad(radius) = theta_rad for the radius in [0, end_px], where theta grows strictly. A Newton step
/// that leaves the bracket is replaced by bisection.
double radius_at_px(const PolynomialFisheye& fisheye, double theta_rad, double end_px) {
  double low = 0.0, high = end_px, radius = std::min(-fisheye.a[0] * theta_rad, high);
  for (int i = 0; i < 100; ++i) {
    const double excess = fisheye.theta_at_rad(radius) - theta_rad;
    if (excess == 0.0) break;
    (excess > 0.0 ? high : low) = radius;
    double next = radius - excess / fisheye.theta_slope_rad_per_px(radius);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - radius) <= 1e-13 * high) return next;
    radius = next;
  }
  return radius;
}

}  // namespace

PolynomialFisheye::PolynomialFisheye(const std::array<double, kCoefficients>& coefficients, double theta_max)
    : a(coefficients), theta_max_rad(theta_max), radius_max_px(std::numeric_limits<double>::quiet_NaN()) {
  if (const auto end_px = bracket_px(*this, theta_max)) radius_max_px = radius_at_px(*this, theta_max, *end_px);
}

double PolynomialFisheye::theta_at_rad(double radius_px) const {
  return std::atan2(radius_px, -value_at(*this, radius_px).f);
}

/// From tan(theta) = r / -f: d theta / d r = (r f' - f) / (r^2 + f^2).
double PolynomialFisheye::theta_slope_rad_per_px(double radius_px) const {
  const Value value = value_at(*this, radius_px);
  return (radius_px * value.slope - value.f) / (radius_px * radius_px + value.f * value.f);
}

std::optional<std::string_view> PolynomialFisheye::problem() const {
  if (!std::ranges::all_of(a, [](double each) { return std::isfinite(each); })) return "a coefficient is missing";
  if (!(a[0] <= -1.0 && a[0] >= -kFarthest_px)) return "a0 must be negative: minus the focal length at the centre";
  if (!(theta_max_rad > 0.0 && theta_max_rad < kPi)) return "theta_max must be above 0 and below pi";
  for (int k = 0; k <= kSteps; ++k) {
    if (!(theta_slope_rad_per_px(radius_max_px * k / kSteps) > 0.0))
      return "theta must grow strictly with the radius up to theta_max";
  }
  return std::nullopt;
}

std::optional<ElevationAt> PolynomialFisheye::elevation_at(double radius_px) const {
  // Beyond theta_max the polynomial may turn back, so only the radius can be checked.
  if (!(radius_px >= 0.0 && radius_px <= radius_max_px)) return std::nullopt;
  return ElevationAt{kPi / 2.0 - theta_at_rad(radius_px), -theta_slope_rad_per_px(radius_px)};
}

std::optional<double> PolynomialFisheye::radius_px(double elevation_rad) const {
  const double theta = kPi / 2.0 - elevation_rad;
  if (!(theta >= 0.0 && theta <= theta_max_rad)) return std::nullopt;
  return radius_at_px(*this, theta, radius_max_px);
}

}  // namespace azimuth
