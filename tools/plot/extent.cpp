#include "tools/plot/extent.hpp"

#include <cmath>

namespace azimuth {

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
