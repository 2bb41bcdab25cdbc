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

/// A pose as it was published, with the reason for its health as far as the status told it.
struct RecordedOutput {
  pose_cov_t pose;
  std::string reason;
};

/// What a daemon published of poses, map and path.
struct RecordedOutputs {
  std::vector<RecordedOutput> poses;     ///< of steps, not those predicted between them; stamps strictly increase
  std::vector<path_pose_t> path;         ///< the last one; empty: none was published
  std::vector<landmark_t> landmarks;     ///< of the last map
  std::uint64_t poses_not_in_order = 0;  ///< left out
  std::uint64_t malformed = 0;           ///< messages that were passed over
};

/// Reads them from a log or session; there may be none. Maps and paths of which a piece is missing are passed over.
/// Reentrant.
FileResult<RecordedOutputs> read_recorded_outputs(const std::filesystem::path& log_or_session,
                                                  const LogOptions& options = {});

}  // namespace azimuth
