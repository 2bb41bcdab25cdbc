#pragma once
// The optics that azimuth calibrate mirror and fisheye find, for azimuth calibrate RUN, which begins with them.

#include <filesystem>

#include "slam/estimator/rig.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"
#include "tools/calibrate/image_files.hpp"
#include "tools/lens_fit/fisheye_calibration.hpp"
#include "tools/plot/canvas.hpp"

namespace azimuth {

/// The mirror in images, and the first of the images.
struct MirrorSearch {
  ImageFile first;
  int images = 0;  ///< number of images looked at
  MirrorCircle mirror;
};

struct RigByMirror {
  MirrorSearch search;
  Rig rig;
};

/// Makes the rig of a run whose images show a mirror, and prints the findings unless `quiet`. The rig has the robot's
/// heading up in the image, and the one of the two front ends that recognises more in the images. Refuses and fails as
/// the command does.
RigByMirror rig_by_mirror(const std::filesystem::path& run, bool quiet);

/// Prints the lens that lamps gave, and how well it fits.
void print_fisheye(const Run& run, const FisheyeCalibration& found, const FisheyeRequest& request);
/// Centre, circles and residuals on the middle image of the run. Fails if the image cannot be read.
PlotCanvas fisheye_picture(const Run& run, const FisheyeCalibration& found);

}  // namespace azimuth
