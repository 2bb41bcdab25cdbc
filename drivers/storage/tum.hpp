#pragma once
// Trajectories in the text format of the TUM benchmark, for evaluation tools: `t x y z qx qy qz qw`.

#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "base/file_result.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The text has one line per pose: seconds with six decimals; metres and quaternion with enough digits to restore the
/// same doubles.
std::string tum_text(std::span<const std::pair<Stamp, Pose2>> trajectory);

/// Writes the output of tum_text() to the file, which is replaced.
[[nodiscard]] FileResult<void> write_tum(std::span<const std::pair<Stamp, Pose2>> trajectory,
                                         const std::filesystem::path& file);

}  // namespace azimuth
