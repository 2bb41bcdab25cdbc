#pragma once
#include <vector>

#include "slam/hypotheses/image_reading.hpp"

namespace azimuth {

/// Associates all bearings of an image jointly, for images in which single pairs are not clear: two bearings that agree
/// with each other may outweigh a nearer one, and a landmark that should be seen supports the bearing that may belong
/// to it. Starting from the undecided `start`, the function follows the most likely readings of the image, bearing by
/// bearing. It accepts a pair when its odds over all these readings reach the margin of the settings. Returns for each
/// bearing the index of its landmark, or -1. Thread contract: reentrant.
std::vector<int> associate_jointly(const ImageReading& start, const ConditionedAssociationSettings& settings);

}  // namespace azimuth
