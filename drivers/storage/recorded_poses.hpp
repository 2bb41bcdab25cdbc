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

/// The pose of one step of the estimator as published by the daemon.
struct RecordedPose {
  Stamp stamp{};
  std::int64_t step = 0;  ///< counts steps from 1
  Pose2 T_map_body;
  std::array<double, 9> covariance{};  ///< covariance of (x [m], y [m], heading [rad]) in the map frame, row by row
  Pose2 T_odom_body;
};

/// Reads the poses of steps (not the predicted ones) on AZIMUTH_POSE from a log or session, in the order of recording;
/// malformed messages are left out. There may be none. Thread contract: reentrant.
FileResult<std::vector<RecordedPose>> read_recorded_poses(const std::filesystem::path& log_or_session,
                                                          const LogOptions& options = {});

}  // namespace azimuth
