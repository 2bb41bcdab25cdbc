#pragma once
// The rig of azimuth calibrate mirror, for other calibrations that begin with it.

#include <filesystem>

#include "slam/estimator/rig.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"
#include "tools/calibrate/read_image.hpp"

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

}  // namespace azimuth
