#pragma once
#include <span>
#include <vector>

#include "slam/perception/sift/key_point.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Finds for each key point the Neighbours::kMost nearest others by Manhattan distance in the image, nearest first
/// (mathematics I.14). Of equally near key points, the one with the smaller index comes first. At most 65535 key
/// points.
///
/// Thread contract: reentrant. Nothing allocates once `out` has grown.
void find_neighbours(std::span<const KeyPoint> key_points, std::vector<Neighbours>& out);

}  // namespace azimuth
