#include "slam/camera/radial_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {

/* The foci F (viewpoint) and C (camera) are at distance 2c on the axis, c^2 = a^2 + b^2, with F above C. A point X of
 * the mirror satisfies |XC| - |XF| = 2a.
 *
 * Seen from C at the angle t off the axis, tan t = r / f:  |XC| = b^2 / (c cos t - a)
 *   tan elevation = (2ac - (a^2 + c^2) cos t) / (b^2 sin t)
 * Seen from F at the elevation e:                           |XF| = b^2 / (a - c sin e)
 *   r / f = b^2 cos e / (2ac - (a^2 + c^2) sin e)
 * The denominators of the distances vanish in the direction of the asymptote, where the mirror ends.
 */

std::optional<std::string_view> HyperbolicMirror::problem() const {
  const bool positive = a_mm > 0.0 && b_mm > 0.0 && focal_length_px > 0.0;
  const bool finite = std::isfinite(a_mm) && std::isfinite(b_mm) && std::isfinite(focal_length_px);
  if (!positive || !finite) return "the mirror's a and b and the focal length must be positive";
  return std::nullopt;
}

std::optional<ElevationAt> HyperbolicMirror::elevation_at(double radius_px) const {
  const double c_mm = hypotenuse(a_mm, b_mm);
  const double tan_t = radius_px / focal_length_px;
  const double cos_t = 1.0 / hypotenuse(1.0, tan_t), sin_t = tan_t * cos_t;
  if (!(radius_px >= 0.0) || !(c_mm * cos_t > a_mm)) return std::nullopt;
  const double squares = a_mm * a_mm + c_mm * c_mm;
  const double up = 2.0 * a_mm * c_mm - squares * cos_t, out = b_mm * b_mm * sin_t;
  // d/dt of atan2(up, out); d t / d r = cos^2 t / f.
  const double per_t = (squares * sin_t * out - up * b_mm * b_mm * cos_t) / (up * up + out * out);
  return ElevationAt{std::atan2(up, out), per_t * cos_t * cos_t / focal_length_px};
}

std::optional<double> HyperbolicMirror::radius_px(double elevation_rad) const {
  const double c_mm = hypotenuse(a_mm, b_mm);
  const double sin_e = std::sin(elevation_rad), cos_e = std::cos(elevation_rad);
  if (!(cos_e >= 0.0) || !(a_mm > c_mm * sin_e)) return std::nullopt;
  return focal_length_px * b_mm * b_mm * cos_e / (2.0 * a_mm * c_mm - (a_mm * a_mm + c_mm * c_mm) * sin_e);
}

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
