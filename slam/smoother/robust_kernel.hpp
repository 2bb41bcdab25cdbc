#pragma once
// Robust kernels, which reduce the weight of outliers among the bearings (mathematics VI.18). Every kernel is quadratic
// for small residuals.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace azimuth {

enum class RobustKernel : std::uint8_t {
  none,    ///< least squares
  huber,   ///< energy grows linearly with the residual beyond the width
  cauchy,  ///< energy grows with the logarithm of the residual
  dcs      ///< dynamic covariance scaling: energy bounded by 1.5 width^2
};

/// Energy of a residual, and its derivative with respect to half the squared residual. This derivative is the weight
/// with which weighted least squares has the same gradient.
struct KernelValue {
  double energy = 0.0;  ///< residual^2 / 2 where the kernel does nothing
  double weight = 1.0;
};

/// `chi2` is the squared residual in standard deviations; `width` is the residual, in standard deviations, at which the
/// kernel sets in. Thread contract: reentrant.
inline KernelValue kernel_value(RobustKernel kernel, double width, double chi2) {
  const double width2 = width * width;
  switch (kernel) {
    case RobustKernel::none:
      break;
    case RobustKernel::huber: {
      if (chi2 <= width2) break;
      const double residual = std::sqrt(chi2);
      return {width * (residual - 0.5 * width), width / residual};
    }
    case RobustKernel::cauchy: {
      const double grown = 1.0 + chi2 / width2;
      return {0.5 * width2 * std::log(grown), 1.0 / grown};
    }
    case RobustKernel::dcs: {
      if (chi2 <= width2) break;
      const double scale = 2.0 * width2 / (width2 + chi2);
      return {0.5 * width2 * (3.0 - 2.0 * scale), scale * scale};
    }
  }
  return {0.5 * chi2, 1.0};
}

}  // namespace azimuth
