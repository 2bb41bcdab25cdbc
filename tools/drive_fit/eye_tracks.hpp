#pragma once
// Names for what nobody names, that no mistake of a rig can spoil.

#include "slam/estimator/rig.hpp"
#include "tools/drive_fit/drive.hpp"

namespace azimuth {

/// Follows what is seen from image to image, by its kind or its looks and by where in the image it goes on: a name
/// stands on all bearings of one track. What is seen again later gets a new one, and what is seen hardly ever none.
///
/// No heading, offset or direction enters: a filter that names landmarks by where the rig has them makes the rig fit by
/// the names that it gives, whatever is wrong with it (SPEC VI.26). Of the odometry it only counts how far the robot
/// drove between two images: when that is too far to follow anything, all tracks end.
void name_by_eye(Drive& drive, const OdometryRig& odometry);

}  // namespace azimuth
