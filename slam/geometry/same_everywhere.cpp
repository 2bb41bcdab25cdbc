#include "slam/geometry/same_everywhere.hpp"

#include <array>

namespace azimuth {
namespace {

/// Coefficients of log(erfc(x) exp(x^2) / t) in Chebyshev polynomials of 2 t - 1, where t = 2 / (2 + x) runs from 1 to
/// 0.
constexpr std::array kCoefficients{
    -1.30265371978170941e+00, 6.41969792356490210e-01,  1.94764732041858360e-02,  -9.56151478680863226e-03,
    -9.46595344482036916e-04, 3.66839497852761447e-04,  4.25233248069077689e-05,  -2.02785781125342418e-05,
    -1.62429000464702561e-06, 1.30365583558052324e-06,  1.56264417220661419e-08,  -8.52380959149265415e-08,
    6.52905443909885149e-09,  5.05934349555146930e-09,  -9.91364156493033066e-10, -2.27365122293183597e-10,
    9.64679110201552702e-11,  2.39403808303911459e-12,  -6.88602752649755322e-12, 8.94487927309072531e-13,
    3.13092139934295813e-13,  -1.12708223613672523e-13, 3.81090525518923205e-16,  7.10609761360923712e-15,
    -1.52302820145710493e-15, -9.45749457128333370e-17, 1.21023718923939085e-16,  -2.81666308811874723e-17};

/// Sums the Chebyshev series by Clenshaw's recurrence.
double chebyshev_sum(double x) {
  double next = 0.0, after = 0.0;
  for (std::size_t i = kCoefficients.size() - 1; i > 0; --i) {
    const double here = kCoefficients[i] + 2.0 * x * next - after;
    after = next;
    next = here;
  }
  return 0.5 * kCoefficients[0] + x * next - after;
}

}  // namespace

double complementary_error(double x) {
  const double size = std::abs(x), t = 2.0 / (2.0 + size);
  const double upper = t * std::exp(chebyshev_sum(2.0 * t - 1.0) - size * size);
  return x < 0.0 ? 2.0 - upper : upper;
}

}  // namespace azimuth
