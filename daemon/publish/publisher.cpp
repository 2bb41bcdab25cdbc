#include "daemon/publish/publisher.hpp"

#include <cstdio>
#include <ctime>
#include <utility>

#include "drivers/io/channels.hpp"
#include "drivers/io/messages.hpp"

namespace azimuth {
namespace {

constexpr std::chrono::seconds kStatusInterval{1};

std::int64_t monotonic_us() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000} * now.tv_sec + now.tv_nsec / 1000;
}

/// Whether `next` has come; if so it moves on by `interval`.
bool due(std::optional<Publisher::Clock::time_point>& next, Publisher::Clock::time_point now,
         Publisher::Clock::duration interval) {
  if (!next) next = now + interval;
  if (now < *next) return false;
  next = now + interval;
  return true;
}

}  // namespace

Publisher::Publisher(const PublishSettings& settings)
    : settings_(settings), sender_(settings.lcm_url, settings.channel_prefix) {
  last_step_.estimate.landmarks.reserve(kTypicalLandmarks);  // it goes round with the pipeline's
}

void Publisher::step(StepResult& result) {
  std::swap(last_step_, result);
  send_pose(last_step_.estimate);
  if (!settings_.print_poses) return;
  std::puts(pose_line(last_step_.estimate).c_str());
  std::fflush(stdout);  // it may be a pipe that somebody watches
}

void Publisher::prediction(const Estimate& estimate) {
  if (any_estimate_ && estimate.stamp <= last_pose_.stamp) return;
  send_pose(estimate);
}

void Publisher::send_pose(const Estimate& estimate) {
  any_estimate_ = true;
  ++published_;
  sender_.send(channel::kPose, pose_message(estimate));
  sender_.send(channel::kBotPose, bot_pose_message(estimate));
  last_pose_ = estimate;
  last_pose_.landmarks.clear();
}

void Publisher::odometry(const OdometryReading& reading) { sender_.send(channel::kOdometry, to_message(reading)); }

void Publisher::bearings(const BearingSet& set) { sender_.send(channel::kBearings, to_message(set)); }

bool Publisher::send_due(Clock::time_point now, const WireLosses& losses, Status& status) {
  if (settings_.map_rate_hz > 0.0) {
    const std::chrono::duration<double> interval(1.0 / settings_.map_rate_hz);
    if (due(next_map_, now, std::chrono::duration_cast<Clock::duration>(interval))) send_map();
  }
  if (!due(next_status_, now, kStatusInterval)) return false;
  send_status(losses, status);
  return true;
}

void Publisher::send_last(Clock::time_point now, const WireLosses& losses, Status& status) {
  next_map_.reset();
  next_status_ = now + kStatusInterval;
  send_map();
  send_status(losses, status);
}

void Publisher::send_map() {
  const std::vector<LandmarkEstimate>& landmarks = last_step_.estimate.landmarks;
  ++maps_;
  for (std::int32_t chunk = 0; chunk < map_chunks(landmarks.size()); ++chunk) {
    fill_map_chunk(landmarks, last_step_.estimate.stamp, maps_, chunk, map_message_);
    sender_.send(channel::kMapChunk, map_message_);
  }
}

void Publisher::send_status(const WireLosses& losses, Status& status) {
  status.any_estimate = any_estimate_;
  status.estimate = last_pose_;
  status.landmarks = last_step_.estimate.landmarks.size();
  status.published = published_;
  status.digest = last_step_.digest;
  status.wires = losses;
  status.publish_failures = sender_.failures();
  status_t message = status_message(status);
  message.utime_mono = monotonic_us();
  message.seq = static_cast<std::int64_t>(++statuses_);
  sender_.send(channel::kStatus, message);
}

}  // namespace azimuth
