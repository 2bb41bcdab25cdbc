#pragma once
// The rig of azimuth calibrate mirror, for other calibrations that begin with it.

#include <filesystem>

#include "slam/estimator/rig.hpp"

namespace azimuth {

/// Makes the rig of a run whose images show a mirror, and prints the findings unless `quiet`. The rig has the robot's
/// heading up in the image, and the one of the two front ends that recognises more in the images. Refuses and fails as
/// the command does.
Rig rig_by_mirror(const std::filesystem::path& run, bool quiet);

}  // namespace azimuth
