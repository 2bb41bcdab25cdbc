#include "slam/geometry/halton.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {

double normal_quantile(double probability) {
  assert(probability > 0.0 && probability < 1.0);
  // Work in the lower tail, where erfc keeps full relative precision.
  const double tail = probability < 0.5 ? probability : 1.0 - probability;
  if (tail == 0.5) return 0.0;
  // Start from the leading terms of the tail expansion, then Halley steps on Phi(x) = tail.
  const double t = std::sqrt(-2.0 * std::log(tail));
  double x = -(t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + 0.04481 * t)));
  for (int step = 0; step < 4; ++step) {
    const double error = 0.5 * complementary_error(-x / std::numbers::sqrt2) - tail;
    const double newton = error * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * x * x);
    x -= newton / (1.0 + 0.5 * x * newton);
  }
  return probability < 0.5 ? x : -x;
}

double van_der_corput(int index, int base) {
  double value = 0.0, digit_weight = 1.0 / base;
  for (int rest = index; rest > 0; rest /= base, digit_weight /= base) value += digit_weight * (rest % base);
  return value;
}

std::vector<Eigen::Matrix<double, 8, 1>> halton_normal_8d(int count) {
  static constexpr std::array kBases{2, 3, 5, 7, 11, 13, 17, 19};
  std::vector<Eigen::Matrix<double, 8, 1>> points(as_size(count));
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 8; ++axis)
      points[as_size(i)](axis) = normal_quantile(van_der_corput(i + 1, kBases[as_size(axis)]));
  return points;
}

}  // namespace azimuth
