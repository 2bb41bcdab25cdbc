#include "slam/association/chi_square.hpp"

#include <cassert>
#include <cmath>

#include "slam/geometry/halton.hpp"

namespace azimuth {

double chi_square_quantile(int degrees_of_freedom, double probability) {
  assert(degrees_of_freedom >= 1);
  if (degrees_of_freedom == 1) {
    const double x = normal_quantile(0.5 + 0.5 * probability);
    return x * x;
  }
  if (degrees_of_freedom == 2) return -2.0 * std::log1p(-probability);
  // Wilson and Hilferty 1931: the cube root of chi-square / n is nearly normal.
  const double n = degrees_of_freedom, spread = 2.0 / (9.0 * n);
  const double root = 1.0 - spread + normal_quantile(probability) * std::sqrt(spread);
  return n * root * root * root;
}

}  // namespace azimuth
