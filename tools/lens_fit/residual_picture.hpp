#pragma once
#include <vector>

#include "slam/sample/image.hpp"
#include "tools/lens_fit/lens.hpp"
#include "tools/lens_fit/lens_fit.hpp"
#include "tools/plot/canvas.hpp"

namespace azimuth {

/// Factor by which residuals are enlarged in the picture.
inline constexpr double kResidualZoom = 20.0;

struct Residual {
  Pixel seen = Pixel::Zero(), expected = Pixel::Zero();
  bool fits = true;
};

/// An image of the camera, overlaid with the lens centre, circles at 30, 60 and 90 degrees from the axis, and the
/// enlarged residuals. `rms_px`: the root mean square for the caption.
PlotCanvas residual_picture(const ImageView& image, const Lens& lens, const std::vector<Residual>& residuals,
                            double rms_px);

/// residual_picture() of all lamp observations of a drive, drawn on one of its images.
PlotCanvas lens_picture(const ImageView& image, const LensDrive& drive, const LensSolution& solution);

}  // namespace azimuth
