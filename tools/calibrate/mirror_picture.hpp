#pragma once
#include "slam/perception/calibration/mirror_finder.hpp"
#include "slam/sample/image.hpp"
#include "tools/plot/canvas.hpp"

namespace azimuth {

/// The image (gray8 or rgb8), overlaid with the mirror's rim, its centre and the inner disc.
PlotCanvas mirror_picture(const ImageView& image, const MirrorCircle& mirror);

}  // namespace azimuth
