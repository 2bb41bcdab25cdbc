#pragma once
#include <azimuth/landmark_t.hpp>
#include <azimuth/path_pose_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"

namespace azimuth {

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
