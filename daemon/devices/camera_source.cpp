#include "daemon/devices/camera_source.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "daemon/pipeline/nap.hpp"

namespace azimuth {
namespace {

/// Into `words`, whose storage is used again: once a second is often enough to matter.
void describe(const CameraState& state, std::string& words) {
  words = text(state.connection);
  const FrameFormat& format = state.description.format;
  auto out = std::back_inserter(words);
  if (state.connection != Connection::running) {
    if (!state.trouble.empty()) fmt::format_to(out, ": {}", state.trouble);
  } else {
    fmt::format_to(out, " ({}, {} {}x{})", state.description.device, name(format.pixels), format.width_px,
                   format.height_px);
  }
  const std::array<std::pair<std::uint64_t, const char*>, 4> losses{
      {{state.missing, "missing"},
       {state.corrupt, "corrupt"},
       {state.stamps_replaced, "with a stamp replaced"},
       {state.stamps_dropped, "dropped for their stamp"}}};
  for (const auto& [count, what] : losses)
    if (count > 0) fmt::format_to(out, ", {} {}", count, what);
}

}  // namespace

CameraSource::CameraSource(const CameraDriverSettings& settings, StreamOpener open, Duration to_stamp, UsbHelp usb)
    : to_stamp_(to_stamp),
      opener_(std::move(open)),
      driver_(settings, [this] { return opener_.open(); }),
      usb_(std::move(usb)) {}

bool CameraSource::turn(Doorbell& bell, SourceWires& wires) {
  if (usb_.turn()) driver_.wake(Clock::now());
  driver_.turn(Clock::now());
  help(Clock::now());
  pass_on(wires);
  report(wires, Clock::now());
  const auto idle = std::min<Clock::duration>(kNap, driver_.due_in(Clock::now()));
  const pollfd images{.fd = driver_.descriptor(), .events = driver_.poll_events(), .revents = 0};
  bell.wait_also(std::array{images, usb_.polled()}, idle);
  return true;
}

void CameraSource::help(Clock::time_point now) {
  const CameraState& state = driver_.state();
  if (state.connection == Connection::running) usb_.works();
  if (usb_.take_end()) driver_.wake(now);
  if (!state.wants_port_reset.empty()) usb_.reset(state.wants_port_reset, now);
}

void CameraSource::pass_on(SourceWires& wires) {
  while (driver_.take(frame_)) {
    if (wires.frames) {
      frame_.stamp += to_stamp_;
      wires.frames->publish(frame_);
    }
    frame_ = Frame{};  // an unwanted one, or the one that was replaced
  }
}

void CameraSource::report(SourceWires& wires, Clock::time_point now) {
  const CameraState& state = driver_.state();
  const bool works = state.connection == Connection::running;
  relay_.pass_on(driver_, !works, "camera: ", wires);
  relay_.pass_on(usb_, "camera: ", wires);
  if (!pace_.due(state.connection, now)) return;
  status_.works = works;
  describe(state, status_.text);
  status_.reconnects = state.reopenings();
  status_.port_resets = usb_.resets();
  status_.images_missing = state.missing;
  status_.images_corrupt = state.corrupt;
  wires.status.publish(status_);
}

}  // namespace azimuth
