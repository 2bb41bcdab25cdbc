#include "slam/perception/colour/radial_line.hpp"

#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

double radial_line_rad(std::span<const CentredPoint> points) {
  CentredPoint sum = CentredPoint::Zero();
  double S_xx = 0.0, S_xy = 0.0, S_yy = 0.0;
  for (const CentredPoint& point : points) {
    sum += point;
    S_xx += point.x() * point.x();
    S_xy += point.x() * point.y();
    S_yy += point.y() * point.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * S_xy, S_xx - S_yy);
  const bool towards_centroid = std::cos(angle) * sum.x() + std::sin(angle) * sum.y() >= 0.0;
  return wrap(towards_centroid ? angle : angle + kPi);
}

}  // namespace azimuth
