#pragma once
// What the daemon left behind, and what the robot's truth says of it.

#include <filesystem>

#include "drivers/storage/run.hpp"
#include "tests/daemon/recorded_messages.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/verify.hpp"

namespace azimuth::test {

/// The only session in a folder of recordings.
std::filesystem::path only_session(const std::filesystem::path& records);

/// One session, whole or cut: what the estimator was given, and its replay.
struct FieldLog {
  Run run;
  ReplayResult replayed;
  Verification verification;  ///< of the recorded poses

  explicit FieldLog(const std::filesystem::path& session);
};

/// All that was published, of a session that was closed.
RecordedMessages published(const std::filesystem::path& session);

/// Where the robot really was at an instant of the drive.
Pose2 true_pose(const Run& truth, Stamp stamp);

/// The last map sent before `stamp`; requires maps of one chunk each.
map_chunk_t map_before(const RecordedMessages& messages, Stamp stamp);

/// Expects each landmark of `before` in `after`, within 5 cm of where it was or within the uncertainty it had there.
void expect_unmoved(const map_chunk_t& before, const map_chunk_t& after);

/// Expects the last pose of a step within the uncertainty it claims, or 10 cm, of the truth.
void expect_at_true_place(const RecordedMessages& messages, const Run& truth);

}  // namespace azimuth::test
