#include "tests/live/field_log.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <gtest/gtest.h>
#include <span>
#include <stdexcept>

#include "drivers/storage/map_codec.hpp"
#include "drivers/storage/recorded_outputs.hpp"
#include "drivers/storage/session.hpp"
#include "settings/configuration.hpp"
#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

constexpr double kThreeSigmaChi2 = 11.83;  // 99.73 % in the plane
constexpr double kLandmark_m = 0.05, kPose_m = 0.1;

Run loaded(const fs::path& session) {
  FileResult<Run> run = load_run(session);
  if (!run) throw std::runtime_error(text(run.error()));
  return *std::move(run);
}

/// Replays the run as `azimuth replay` does, with the rig and the configuration from the log.
ReplayResult replay_of(const Run& run) {
  const FileResult<Rig> rig = read_rig(run.rig_toml, run.rig_file);
  const FileResult<Configuration> configuration = read_configuration(run.configuration_toml, run.configuration_file);
  if (!rig || !configuration) throw std::runtime_error("no rig or configuration in the log");
  Configuration start = *configuration;
  start.map.asks_odometry = run.since_map.has_value();
  MapSnapshot map;
  const bool from_map = !run.map.empty();
  if (from_map && decode_map(std::as_bytes(std::span(run.map)), map)) throw std::runtime_error("no map in the log");
  return replay(run, *rig, configured_estimator(*rig, start, from_map ? &map : nullptr), configuration->stage);
}

std::vector<RecordedPose> poses_of(const fs::path& session) {
  FileResult<std::vector<RecordedPose>> poses = read_recorded_poses(session);
  if (!poses) throw std::runtime_error(text(poses.error()));
  return *std::move(poses);
}

template <class Message>
void append(std::vector<Message>& all, const std::vector<Message>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

double chi2(const Eigen::Vector2d& error_m, const Eigen::Matrix2d& covariance_m2) {
  return error_m.dot(covariance_m2.inverse() * error_m);
}

Pose2 map_pose_of(const pose_cov_t& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

}  // namespace

fs::path only_session(const fs::path& records) {
  std::vector<fs::path> sessions;
  for (const auto& entry : fs::directory_iterator(records)) sessions.push_back(entry.path());
  if (sessions.size() != 1) throw std::runtime_error(std::to_string(sessions.size()) + " sessions, not one");
  return sessions.front();
}

FieldLog::FieldLog(const fs::path& session)
    : run(loaded(session)), replayed(replay_of(run)), verification(verify(poses_of(session), replayed)) {}

RecordedMessages published(const fs::path& session) {
  RecordedMessages all;
  for (const SegmentFile& segment : session_segments(session)) {
    const RecordedMessages some = read_messages(segment.file);
    append(all.poses, some.poses);
    append(all.map_chunks, some.map_chunks);
    append(all.paths, some.paths);
    append(all.statuses, some.statuses);
    all.undecodable += some.undecodable;
  }
  return all;
}

Pose2 true_pose(const Run& truth, Stamp stamp) {
  const auto after = std::ranges::lower_bound(truth.truth, stamp, {}, &TruthPose::stamp);
  if (after == truth.truth.begin()) return truth.truth.front().T_world_body;
  if (after == truth.truth.end()) return truth.truth.back().T_world_body;
  const auto before = after - 1;
  const double fraction = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return interpolate(before->T_world_body, after->T_world_body, fraction);
}

map_chunk_t map_before(const RecordedMessages& messages, Stamp stamp) {
  map_chunk_t last{};
  for (const map_chunk_t& map : messages.map_chunks) {
    if (map.chunks != 1) throw std::runtime_error("a map of several chunks");
    if (map.utime < to_us(stamp)) last = map;
  }
  return last;
}

void expect_unmoved(const map_chunk_t& before, const map_chunk_t& after) {
  for (const landmark_t& old : before.landmarks) {
    const auto now = std::ranges::find(after.landmarks, old.id, &landmark_t::id);
    if (now == after.landmarks.end()) {
      ADD_FAILURE() << "landmark " << old.id << " is gone";
      continue;
    }
    const Eigen::Vector2d moved_m(now->x_m - old.x_m, now->y_m - old.y_m);
    const Eigen::Matrix2d covariance_m2{{old.covariance[0], old.covariance[1]}, {old.covariance[1], old.covariance[2]}};
    EXPECT_TRUE(moved_m.norm() < kLandmark_m || chi2(moved_m, covariance_m2) < kThreeSigmaChi2)
        << "landmark " << old.id << " moved by " << moved_m.transpose() << " m, chi2 " << chi2(moved_m, covariance_m2);
  }
}

/// The map's frame is defined by the first pose.
void expect_at_true_place(const RecordedMessages& messages, const Run& truth) {
  ASSERT_FALSE(messages.poses.empty());
  const pose_cov_t &first = messages.poses.front(), &last = messages.poses.back();
  const Pose2 T_map_world = map_pose_of(first) * inverse(true_pose(truth, stamp_from_us(first.utime)));
  const Pose2 T_map_body = T_map_world * true_pose(truth, stamp_from_us(last.utime));
  const Eigen::Vector2d error_m = map_pose_of(last).position() - T_map_body.position();
  const Eigen::Matrix2d covariance_m2{{last.covariance[0], last.covariance[1]},
                                      {last.covariance[3], last.covariance[4]}};
  EXPECT_TRUE(error_m.norm() < kPose_m || chi2(error_m, covariance_m2) < kThreeSigmaChi2)
      << "wrong by " << error_m.transpose() << " m, chi2 " << chi2(error_m, covariance_m2);
}

}  // namespace azimuth::test
