#include "daemon/devices/shared_camera_source.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "daemon/pipeline/nap.hpp"

namespace azimuth {
SharedCameraSource::SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic,
                                       Clock::duration silent_after)
    : socket_(socket.string()),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      camera_(std::move(socket)),
      silent_after_(silent_after) {
  set_.bearings.reserve(kTypicalBearings);
}

bool SharedCameraSource::turn(Doorbell& bell, SourceWires& wires) {
  const Clock::time_point now = Clock::now();
  camera_.turn(now);
  const bool connected = camera_.state().connected;
  if (pass_on(wires) || connected != was_connected_) last_sample_ = now;
  was_connected_ = connected;
  report(wires, now);
  const auto until_due = camera_.next_turn() - Clock::now();
  bell.wait_also(camera_.descriptor(), POLLIN, std::min<std::chrono::nanoseconds>(kNap, until_due));
  return true;
}

/// False: there was nothing that is wanted.
bool SharedCameraSource::pass_on(SourceWires& wires) {
  bool any = false;
  while (camera_.take(set_)) {
    if (!wires.bearings) continue;
    any = true;
    set_.stamp += epoch_minus_monotonic_;
    wires.bearings->push(set_);
  }
  while (camera_.take(frame_)) {
    if (wires.frames) {
      any = true;
      frame_.stamp += epoch_minus_monotonic_;
      wires.frames->publish(frame_);
    }
    frame_ = Frame{};  // an unwanted one, or the one that was replaced
  }
  return any;
}

SharedCameraSource::Condition SharedCameraSource::condition(const SourceWires& wires, Clock::time_point now) const {
  const SharedCameraState& state = camera_.state();
  // A server that is free greets at once, though not always in the turn that connects: until then nothing has changed.
  if (state.waiting_since && now - *state.waiting_since <= silent_after_) return condition_;
  if (!state.connected) return Condition::unconnected;
  if (wires.frames && state.format.width_px == 0) return Condition::without_images;
  return now - last_sample_ > silent_after_ ? Condition::silent : Condition::running;
}

std::string SharedCameraSource::description() const {
  switch (condition_) {
    case Condition::unconnected:
      return socket_ + ' ' + camera_.state().error;
    case Condition::without_images:
      return socket_ + " sends no images";
    case Condition::silent:
      return fmt::format("{} has sent nothing for {} s", socket_, std::chrono::duration<double>(silent_after_).count());
    case Condition::unknown:
    case Condition::running:
      break;
  }
  const FrameFormat& format = camera_.state().format;
  if (format.width_px == 0) return "running (" + socket_ + ')';
  return fmt::format("running ({}, {} {}x{})", socket_, azimuth::name(format.pixels), format.width_px,
                     format.height_px);
}

/// When the condition has changed, and once at the start.
void SharedCameraSource::report(SourceWires& wires, Clock::time_point now) {
  const Condition before = std::exchange(condition_, condition(wires, now));
  if (condition_ == before) return;
  const SharedCameraState& state = camera_.state();
  DeviceStatus news{.text = description(),
                    .works = condition_ == Condition::running,
                    .reconnects = state.connections > 0 ? state.connections - 1 : 0};
  DeviceEvent event{!news.works, "camera: " + news.text};
  wires.events.push(event);
  wires.status.publish(news);
}

}  // namespace azimuth
