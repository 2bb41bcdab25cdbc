#pragma once
// What every calibration of a fisheye says of the lens that it found.

#include "tools/lens_fit/lens.hpp"

namespace azimuth {

/// Centre, coefficients, and radii up to `seen_to_rad`. `scale_known`: else a0 is the one the lens began with.
void print_lens(const Lens& lens, const LensCovariance& covariance, double seen_to_rad, bool scale_known);

}  // namespace azimuth
