#pragma once
// What <cmath> has too, but with other last bits on arm64 than on x86: estimates are to be the same on both.

#include <cmath>

namespace azimuth {

/// Length of the vector (a, b), in the type of its parts, which are neither near the largest numbers nor near the
/// smallest.
template <typename Real>
Real hypotenuse(Real a, Real b) {
  return std::sqrt(a * a + b * b);
}

/// 1 - erf(x), to a relative 1e-14 down to 1e-300: twice the chance that a normal variable lies above sqrt(2) x sigma.
double complementary_error(double x);

}  // namespace azimuth
