#pragma once
// The daemon's recordings, and their comparison with the robot's true drive.

#include <filesystem>

#include "drivers/storage/run.hpp"
#include "tests/daemon/recorded_messages.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/verify.hpp"

namespace azimuth::test {

/// The only session in a folder of recordings.
std::filesystem::path only_session(const std::filesystem::path& records);

/// One session, complete or cut: the estimator's input, and its replay.
struct FieldLog {
  Run run;
  ReplayResult replayed;
  Verification verification;  ///< Verification of the recorded poses

  explicit FieldLog(const std::filesystem::path& session);
};

/// All published messages of a session that was closed.
RecordedMessages published(const std::filesystem::path& session);

/// The robot's true pose at an instant of the drive.
Pose2 true_pose(const Run& truth, Stamp stamp);

/// The last map sent before `stamp`. Every map must have one chunk.
map_chunk_t map_before(const RecordedMessages& messages, Stamp stamp);

/// Expects each landmark of `before` in `after`, moved by at most 5 cm or by less than its uncertainty in `before`.
void expect_unmoved(const map_chunk_t& before, const map_chunk_t& after);

/// Expects the last pose to agree with the truth within its uncertainty, or within 10 cm.
void expect_at_true_place(const RecordedMessages& messages, const Run& truth);

}  // namespace azimuth::test
