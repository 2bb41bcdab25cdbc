#pragma once
// The printed description of a lens, for every calibration of a fisheye.

#include "tools/lens_fit/lens.hpp"

namespace azimuth {

/// Prints centre, coefficients, and radii up to `seen_to_rad`. Without `scale_known`, a0 still has its initial value.
void print_lens(const Lens& lens, const LensCovariance& covariance, double seen_to_rad, bool scale_known);

}  // namespace azimuth
