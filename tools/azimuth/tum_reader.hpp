#pragma once
#include <istream>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// Reads a trajectory in the text format of the TUM benchmark: `t x y z qx qy qz qw` per line, `#` begins a comment.
/// The heading is the rotation about z. Refuses lines without eight finite numbers, quaternions far from length 1 and
/// stamps that do not increase. Errors name `file`.
FileResult<std::vector<StampedPose>> read_tum(std::istream& text, const std::string& file);

}  // namespace azimuth
