#include "daemon/pipeline/played_source.hpp"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <sys/eventfd.h>
#include <system_error>
#include <utility>

#include "daemon/pipeline/paces.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

UniqueFd make_bell() {
  UniqueFd bell(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  if (!bell) throw std::system_error(errno, std::generic_category(), "eventfd");
  return bell;
}

}  // namespace

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

struct PlayedSource::OneBuffer : FramePool {
  explicit OneBuffer(ReadFrame read_frame) : FramePool(make_bell()), read(std::move(read_frame)) {}
  ReadFrame read;
};

PlayedSource::PlayedSource(Recording recording, double speed, ReadFrame read_frame)
    : player_(std::move(recording), speed) {
  set_.bearings.reserve(kTypicalBearings);
  if (read_frame) buffer_ = std::make_shared<OneBuffer>(std::move(read_frame));
}

bool PlayedSource::turn(Doorbell& bell, SourceWires& wires) {
  if (!frame_is_back()) {
    bell.wait_also(buffer_->descriptor(), POLLIN, kNap);
    return true;
  }
  if (player_.over()) {
    bell.wait(kNap);
    return false;
  }
  const auto due_in = player_.due_in(RunPlayer::Clock::now(), kNap);
  if (due_in > 0ns) {
    bell.wait(due_in);
  } else if (hand_over(player_.peek(), wires)) {
    player_.advance();
  } else {
    bell.wait(kNap);
  }
  return true;
}

bool PlayedSource::frame_is_back() {
  if (frame_is_out_ && buffer_->take_returned() != 0) frame_is_out_ = false;
  return !frame_is_out_;
}

/// False: there is no room yet. The bell rings when there is.
bool PlayedSource::hand_over(const RunPlayer::Sample& sample, SourceWires& wires) {
  if (sample.frame) {
    if (wires.frames) send_frame(*sample.frame, sample.stamp, *wires.frames);
    return true;
  }
  if (sample.bearings) {
    if (!wires.bearings) return true;
    if (!wires.bearings->has_room()) return false;
    // The set is copied, because the storage that circulates on the wires is larger than that of the recording.
    set_ = *sample.bearings;
    return wires.bearings->push(set_);
  }
  if (!wires.odometry.has_room()) return false;
  OdometryReading reading = *sample.odometry;
  return wires.odometry.push(reading);
}

/// An image that cannot be read is sent without bytes, so that perception reports it.
void PlayedSource::send_frame(std::size_t index, Stamp stamp, FramesWire& frames) {
  assert(buffer_ && "a recording with frames needs somebody who reads them");
  const ImageView image = buffer_->read(index);
  Frame frame(buffer_, 0, image.format, image.bytes);
  frame.stamp = stamp;
  frame.sequence = index;
  frame_is_out_ = true;
  frames.publish(frame);
}

}  // namespace azimuth
