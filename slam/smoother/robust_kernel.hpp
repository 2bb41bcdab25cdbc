#pragma once
// Kernels that let a bearing of something else pull less (SPEC VI.18). All are quadratic for small residuals.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace azimuth {

enum class RobustKernel : std::uint8_t {
  none,    ///< least squares
  huber,   ///< grows with the residual beyond the width
  cauchy,  ///< grows with its logarithm
  dcs      ///< dynamic covariance scaling: bounded, by 1.5 times the width's square
};

/// Energy of a residual, and its derivative by half the squared residual: the weight that makes the least squares
/// problem of the moment have the same gradient.
struct KernelValue {
  double energy = 0.0;  ///< residual^2 / 2 where the kernel does nothing
  double weight = 1.0;
};

/// `chi2` is the squared residual in standard deviations, `width` where the kernel begins to tell, likewise. Thread
/// contract: reentrant.
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
