#pragma once
// Data association by image tracking for bearings without identity, independent of mistakes in the rig.

#include "slam/estimator/rig.hpp"
#include "tools/drive_fit/drive.hpp"

namespace azimuth {

/// Tracks bearings from image to image by kind or descriptor and by azimuth. All bearings of one track get the same
/// identity. A landmark that reappears later gets a new identity; bearings of short tracks get none.
///
/// The tracking uses no heading, offset or direction of the rig. A filter that associates by the rig's geometry would
/// choose associations that fit even a wrong rig (mathematics VI.26). The tracking takes only the distance between two
/// images from odometry: all tracks end if the robot drove too far between them.
void name_by_eye(Drive& drive, const OdometryRig& odometry);

}  // namespace azimuth
