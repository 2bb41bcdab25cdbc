#pragma once
// Functions that replace those of <cmath> whose last bits differ between arm64 and x86, so that estimates are equal on
// both.

#include <cmath>

namespace azimuth {

/// Length of the vector (a, b). The components must not be so large or so small that their squares overflow or
/// underflow.
template <typename Real>
Real hypotenuse(Real a, Real b) {
  return std::sqrt(a * a + b * b);
}

/// 1 - erf(x), with a relative error of 1e-14 for values down to 1e-300: twice the probability that a standard normal
/// variable exceeds sqrt(2) x.
double complementary_error(double x);

}  // namespace azimuth
