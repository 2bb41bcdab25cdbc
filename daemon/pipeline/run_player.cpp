#include "daemon/pipeline/run_player.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace azimuth {

RunPlayer::RunPlayer(Recording recording, double speed) : recording_(std::move(recording)), speed_(speed) {
  assert(speed >= 0.0);
}

RunPlayer::Sample RunPlayer::peek() {
  Sample next;
  const auto is_earlier = [&](Stamp stamp) {
    return (!next.odometry && !next.bearings && !next.frame) || stamp < next.stamp;
  };
  if (next_odometry_ < recording_.odometry.size()) {
    const OdometryReading& reading = recording_.odometry[next_odometry_];
    next = {.odometry = &reading, .stamp = reading.stamp};
  }
  if (next_set_ < recording_.bearings.size()) {
    BearingSet& set = recording_.bearings[next_set_];
    if (is_earlier(set.stamp)) next = {.bearings = &set, .stamp = set.stamp};
  }
  if (next_frame_ < recording_.frames.size()) {
    const Stamp stamp = recording_.frames[next_frame_];
    if (is_earlier(stamp)) next = {.frame = next_frame_, .stamp = stamp};
  }
  return next;
}

std::chrono::nanoseconds RunPlayer::due_in(Clock::time_point now, std::chrono::nanoseconds limit) {
  const Stamp stamp = peek().stamp;
  if (!started_) {
    started_ = true;
    start_ = now;
    first_stamp_ = stamp;
  }
  if (speed_ == 0.0) return {};
  // Computed in seconds first: a gap of years between stamps must not overflow nanoseconds.
  const double due_s = to_seconds(stamp - first_stamp_) / speed_;
  const double left_s = due_s - std::chrono::duration<double>(now - start_).count();
  const double limit_s = std::chrono::duration<double>(limit).count();
  return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * std::min(left_s, limit_s)));
}

void RunPlayer::advance() {
  const Sample sample = peek();
  if (sample.odometry) ++next_odometry_;
  if (sample.bearings) ++next_set_;
  if (sample.frame) ++next_frame_;
}

}  // namespace azimuth
