#pragma once
#include <array>
#include <azimuth/landmark_t.hpp>
#include <azimuth/path_pose_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
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

/// A published pose, with the reason for its health according to the status.
struct RecordedOutput {
  pose_cov_t pose;
  std::string reason;
};

/// The poses, map and path that a daemon published.
struct RecordedOutputs {
  /// Poses of steps, without predicted ones; stamps strictly increase.
  std::vector<RecordedOutput> poses;
  std::vector<path_pose_t> path;         ///< the last path; empty: none was published
  std::vector<landmark_t> landmarks;     ///< landmarks of the last map
  std::uint64_t poses_not_in_order = 0;  ///< poses that were left out
  std::uint64_t malformed = 0;           ///< messages that were skipped
};

/// Reads the outputs from a log or session; there may be none. Maps and paths with a missing piece are skipped. Thread
/// contract: reentrant.
FileResult<RecordedOutputs> read_recorded_outputs(const std::filesystem::path& log_or_session,
                                                  const LogOptions& options = {});

}  // namespace azimuth
