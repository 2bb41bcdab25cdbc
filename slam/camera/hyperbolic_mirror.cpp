#include "slam/camera/hyperbolic_mirror.hpp"

#include <cmath>

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

}  // namespace azimuth
