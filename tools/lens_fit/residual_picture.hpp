#pragma once
#include <vector>

#include "slam/sample/image.hpp"
#include "tools/lens_fit/lens.hpp"
#include "tools/plot/canvas.hpp"

namespace azimuth {

/// Residuals are drawn so many times as long as they are.
inline constexpr double kResidualZoom = 20.0;

struct Residual {
  Pixel seen = Pixel::Zero(), expected = Pixel::Zero();
  bool fits = true;
};

/// On an image of the lens: its centre, circles 30, 60 and 90 degrees from the axis, and how far each thing that was
/// seen is from where the fit has it. `rms_px`: what is said of them all.
PlotCanvas residual_picture(const ImageView& image, const Lens& lens, const std::vector<Residual>& residuals,
                            double rms_px);

}  // namespace azimuth
