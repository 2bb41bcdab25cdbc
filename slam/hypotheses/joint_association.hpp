#pragma once
#include <vector>

#include "slam/hypotheses/image_reading.hpp"

namespace azimuth {

/// For each bearing an index of a landmark, or -1, where single pairs are not clear: two bearings that agree with each
/// other may outweigh one that is nearer, and a landmark that should be seen speaks for the bearing that may be of it.
/// From `start`, with nothing decided, the likeliest readings of the image as a whole are followed, bearing by bearing;
/// a pair is taken when its odds in all of them together are those that the settings ask for.
/// Thread contract: reentrant.
std::vector<int> associate_jointly(const ImageReading& start, const ConditionedAssociationSettings& settings);

}  // namespace azimuth
