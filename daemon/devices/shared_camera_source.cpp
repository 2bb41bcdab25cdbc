#include "daemon/devices/shared_camera_source.hpp"

#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "daemon/devices/status_words.hpp"

namespace azimuth {
namespace {

constexpr DeviceCondition kWithoutImages{Connection::silent, "no images"};

}  // namespace

SharedCameraSource::SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic,
                                       Clock::duration silent_after)
    : socket_(socket.string()),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      camera_(std::move(socket)),
      silent_after_(silent_after) {
  set_.bearings.reserve(kTypicalBearings);
}

void SharedCameraSource::work(Clock::time_point now, SourceWires& wires) {
  camera_.turn(now);
  const bool connected = camera_.state().connected;
  if (pass_on(wires) || connected != was_connected_) last_sample_ = now;
  was_connected_ = connected;
  condition_ = judge(wires.frames != nullptr, now);
}

/// False: no wanted sample was received.
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
    frame_ = Frame{};  // releases an unwanted frame, or the frame that publish() replaced
  }
  return any;
}

std::optional<DeviceCondition> SharedCameraSource::judge(bool wants_frames, Clock::time_point now) const {
  const SharedCameraState& state = camera_.state();
  // A free server sends its greeting at once, but possibly in a later turn than the connection. Until then the
  // condition stays as it was.
  if (state.waiting_since && now - *state.waiting_since <= silent_after_) return condition_;
  if (!state.connected) return kAway;
  if (wants_frames && state.format.width_px == 0) return kWithoutImages;
  return now - last_sample_ > silent_after_ ? kSilent : kRunning;
}

void SharedCameraSource::describe(DeviceStatus& status) const {
  const SharedCameraState& state = camera_.state();
  const FrameFormat& format = state.format;
  status.text.clear();
  auto out = std::back_inserter(status.text);
  if (condition_ == kAway) {
    fmt::format_to(out, "{} {}", socket_, state.error);
  } else if (condition_ == kWithoutImages) {
    fmt::format_to(out, "{} sends no images", socket_);
  } else if (condition_ == kSilent) {
    fmt::format_to(out, "{} has sent nothing for {} s", socket_, std::chrono::duration<double>(silent_after_).count());
  } else if (format.width_px == 0) {
    fmt::format_to(out, "running ({})", socket_);
  } else {
    fmt::format_to(out, "running ({}, {} {}x{})", socket_, azimuth::name(format.pixels), format.width_px,
                   format.height_px);
  }
  append_losses({{state.frames_missing + state.sets_missing, "missing"},
                 {state.frames_replaced + state.sets_replaced, "not taken in time"},
                 {state.malformed, "malformed"}},
                status.text);
  status.reconnects = state.connections > 0 ? state.connections - 1 : 0;
  status.images_missing = state.frames_missing;
}

}  // namespace azimuth
