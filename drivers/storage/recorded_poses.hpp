#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The pose of one step of the estimator, as the daemon published it.
struct RecordedPose {
  Stamp stamp{};
  std::int64_t step = 0;  ///< counts steps from 1
  Pose2 T_map_body;
  std::array<double, 9> covariance{};  ///< of (x [m], y [m], heading [rad]) in the map frame, row by row
  Pose2 T_odom_body;
};

/// The poses of steps (not those predicted between them) on AZIMUTH_POSE in a log or session, in the order in which
/// they were recorded; malformed messages are left out. May be none. Reentrant.
FileResult<std::vector<RecordedPose>> read_recorded_poses(const std::filesystem::path& log_or_session,
                                                          const LogOptions& options = {});

}  // namespace azimuth
