#include "daemon/publish/publisher.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/clocks.hpp"
#include "drivers/estimates/estimate_messages.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

bool has_moved(const Pose2& from, const Pose2& to) {
  return (to.position() - from.position()).norm() > PathWatch::kMoved_m ||
         std::abs(wrap(to.heading_rad - from.heading_rad)) > PathWatch::kTurned_rad;
}

constexpr std::chrono::seconds kStatusInterval{1};
constexpr std::chrono::milliseconds kFreshStatus{200};
constexpr std::chrono::seconds kDocumentsInterval{5};
constexpr std::chrono::seconds kPathInterval{3};
constexpr double kPathPosesPerSecond = 600.0;  // 20 kB/s: a long path must not fill the network or the log

/// True: the time `next` has come. Then sets `next` to `interval` from now.
bool due(std::optional<Publisher::Clock::time_point>& next, Publisher::Clock::time_point now,
         Publisher::Clock::duration interval) {
  if (!next) next = now + interval;
  if (now < *next) return false;
  next = now + interval;
  return true;
}

}  // namespace

bool PathWatch::look(std::span<const PathPose> path) {
  bool moved = !any_sent_ && !path.empty();
  std::size_t at = 0;
  for (const PathPose& pose : path) {
    while (at < told_.size() && told_[at].stamp < pose.stamp) ++at;  // the path no longer has this pose
    if (at == told_.size()) {
      told_.push_back(pose);  // AZIMUTH_POSE has published this pose
    } else if (told_[at].stamp == pose.stamp) {
      moved = moved || has_moved(told_[at].T_map_body, pose.T_map_body);
    } else {
      continue;  // a new pose between two published ones
    }
    ++at;
  }
  return moved || at < told_.size();
}

void PathWatch::sent(std::span<const PathPose> path) {
  told_.assign(path.begin(), path.end());
  any_sent_ = true;
}

Publisher::Publisher(const PublishSettings& settings, std::optional<Duration> epoch_minus_monotonic)
    : settings_(settings),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      sender_(settings.lcm_url, settings.channel_prefix) {
  last_step_.estimate.landmarks.reserve(kTypicalLandmarks);  // shared with the pipeline
  last_step_.estimate.accepted.reserve(kTypicalLandmarks);
  last_step_.expected.bearings.reserve(kTypicalLandmarks);
}

void Publisher::documents(std::vector<Document> documents) {
  std::erase_if(documents, [](const Document& document) { return document.of_the_start; });
  documents_ = std::move(documents);
}

/// Sends a message and passes it to the listeners, which may record it. Not for samples.
template <class Message>
void Publisher::send(std::string_view channel, Message& message) {
  sender_.send(channel, message);
  for (const Listener& listener : listeners_) listener(channel, sender_.last(), stamp_from_us(message.utime));
}

std::int64_t Publisher::monotonic_us(Stamp stamp) const {
  return epoch_minus_monotonic_ ? to_us(stamp - *epoch_minus_monotonic_) : 0;
}

void Publisher::step(StepResult& result) {
  std::swap(last_step_, result);
  send_pose(last_step_.estimate);
  // Expectations are sent before sightings, because a receiver of both waits for the sightings.
  if (settings_.echo_samples && last_step_.expected.stamp) send_expectations();
  if (settings_.echo_samples) send_sightings();
  if (!settings_.print_poses) return;
  std::puts(pose_line(last_step_.estimate).c_str());
  std::fflush(stdout);  // standard output may be a pipe with a waiting reader
}

void Publisher::prediction(const Estimate& estimate) {
  if (any_estimate_ && estimate.stamp <= last_pose_.stamp) return;
  send_pose(estimate);
}

void Publisher::send_pose(const Estimate& estimate) {
  any_estimate_ = true;
  ++published_;
  pose_cov_t pose = to_message(estimate);
  pose.utime_mono = monotonic_us(estimate.stamp);
  pose_t bot_pose = bot_pose_message(estimate);
  send(channel::kPose, pose);
  send(channel::kBotPose, bot_pose);
  last_pose_ = estimate;
  last_pose_.landmarks.clear();
}

/// Listeners are not called: they record for replays, and a replay computes the same sightings.
void Publisher::send_sightings() {
  fill_message(last_step_.estimate, sightings_message_);
  sightings_message_.utime_mono = monotonic_us(last_step_.estimate.stamp);
  sender_.send(channel::kSightings, sightings_message_);
}

/// Listeners are not called, for the same reason. An estimator without a map has no expectations to send.
void Publisher::send_expectations() {
  if (last_step_.expected.bearings.empty()) return;
  fill_message(last_step_, expectations_message_);
  expectations_message_.utime_mono = monotonic_us(last_step_.estimate.stamp);
  sender_.send(channel::kExpected, expectations_message_);
}

void Publisher::odometry(const OdometryReading& reading) {
  odometry_t message = to_message(reading);
  message.utime_mono = monotonic_us(reading.stamp);
  sender_.send(channel::kOdometry, message);
}

void Publisher::bearings(const BearingSet& set) {
  if (is_plain(set)) {
    bearings_t message = to_message(set);
    message.utime_mono = monotonic_us(set.stamp);
    sender_.send(channel::kBearings, message);
  } else {
    features_t message = to_features_message(set);
    message.utime_mono = monotonic_us(set.stamp);
    sender_.send(channel::kFeatures, message);
  }
}

void Publisher::hasten_status() {
  if (next_status_) next_status_ = std::min(*next_status_, last_status_ + kFreshStatus);
}

bool Publisher::send_due(Clock::time_point now, Status& status) {
  if (!next_documents_ || now >= *next_documents_) {
    next_documents_ = now + kDocumentsInterval;
    send_documents();
  }
  if (settings_.map_rate_hz > 0.0 && due(next_map_, now, clock_duration(1.0 / settings_.map_rate_hz))) send_map();
  if (!due(next_status_, now, kStatusInterval)) return false;
  last_status_ = now;
  send_status(status, now);
  return true;
}

void Publisher::send_last(Clock::time_point now, Status& status) {
  next_map_.reset();
  next_status_ = now + kStatusInterval;
  send_map();
  send_status(status, now);
}

void Publisher::send_map() {
  const std::vector<LandmarkEstimate>& landmarks = last_step_.estimate.landmarks;
  ++maps_;
  for (std::int32_t chunk = 0; chunk < map_chunks(landmarks.size()); ++chunk) {
    fill_map_chunk(landmarks, last_step_.estimate.stamp, maps_, chunk, map_message_);
    map_message_.utime_mono = monotonic_us(last_step_.estimate.stamp);
    send(channel::kMapChunk, map_message_);
  }
}

bool Publisher::wants_path(Clock::time_point now) {
  const auto for_its_length = clock_duration(static_cast<double>(path_poses_) / kPathPosesPerSecond);
  return due(next_path_, now, std::max<Clock::duration>(kPathInterval, for_its_length));
}

void Publisher::path(std::span<const PathPose> path) {
  path_poses_ = path.size();
  if (path_watch_.look(path)) send_path(path);
}

void Publisher::last_path(std::span<const PathPose> path) {
  if (!path.empty()) send_path(path);
}

void Publisher::send_path(std::span<const PathPose> path) {
  ++paths_;
  for (std::int32_t chunk = 0; chunk < path_chunks(path.size()); ++chunk) {
    fill_path_chunk(path, paths_, chunk, path_message_);
    path_message_.utime_mono = path.empty() ? 0 : monotonic_us(path.back().stamp);
    send(channel::kPath, path_message_);
  }
  path_watch_.sent(path);
}

/// Listeners are not called: a recorder has its own copy of the documents.
void Publisher::send_documents() {
  if (!settings_.echo_samples) return;  // without samples there is nothing to replay
  for (const Document& document : documents_) {
    document_t message = to_message(document.name, document.text, last_pose_.stamp);
    message.utime_mono = now_on(CLOCK_MONOTONIC).count();
    message.seq = static_cast<std::int64_t>(++documents_sent_);
    sender_.send(channel::kDocument, message);
  }
}

/// Listeners are not called: the message describes the disk to which they write.
void Publisher::send_kept(const Status& status) {
  if (status.record.text.empty() && status.map.written_us == 0) return;
  kept_t message = kept_message(status);
  message.utime_mono = now_on(CLOCK_MONOTONIC).count();
  message.seq = static_cast<std::int64_t>(statuses_ + 1);
  sender_.send(channel::kKept, message);
}

void Publisher::send_status(Status& status, Clock::time_point now) {
  status.any_estimate = any_estimate_;
  status.estimate = last_pose_;
  status.landmarks = last_step_.estimate.landmarks.size();
  status.published = published_;
  status.digest = last_step_.digest;
  status.publish_failures = sender_.failures();
  pace_watch_.look(now, status);
  status.pace = pace_watch_.text();
  send_kept(status);
  status_t message = status_message(status);
  message.utime_mono = now_on(CLOCK_MONOTONIC).count();
  message.seq = static_cast<std::int64_t>(++statuses_);
  send(channel::kStatus, message);
}

}  // namespace azimuth
