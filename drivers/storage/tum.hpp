#pragma once
// Trajectories in the text format of the TUM benchmark, which evaluation tools read: `t x y z qx qy qz qw`.

#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "base/file_result.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// One line a pose: seconds with six decimals, metres and quaternion with the digits that give the same doubles back.
std::string tum_text(std::span<const std::pair<Stamp, Pose2>> trajectory);

/// Writes that text, replacing the file.
[[nodiscard]] FileResult<void> write_tum(std::span<const std::pair<Stamp, Pose2>> trajectory,
                                         const std::filesystem::path& file);

}  // namespace azimuth
