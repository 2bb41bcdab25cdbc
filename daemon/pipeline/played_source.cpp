#include "daemon/pipeline/played_source.hpp"

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
