#pragma once
#include <istream>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// Reads a trajectory in the text format of the TUM benchmark: `t x y z qx qy qz qw` a line, `#` begins a comment. The
/// heading is the rotation about z. Refuses what is not eight finite numbers, a quaternion far from length 1 and stamps
/// that do not increase; `file` is what errors name.
FileResult<std::vector<StampedPose>> read_tum(std::istream& text, const std::string& file);

}  // namespace azimuth
