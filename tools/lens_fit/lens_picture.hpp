#pragma once
#include "tools/lens_fit/lens_fit.hpp"
#include "tools/lens_fit/residual_picture.hpp"

namespace azimuth {

/// residual_picture() of all lamp observations of a drive, drawn on one of its images.
PlotCanvas lens_picture(const ImageView& image, const LensDrive& drive, const LensSolution& solution);

}  // namespace azimuth
