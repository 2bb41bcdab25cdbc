#include "daemon/devices/camera_source.hpp"

#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "daemon/devices/status_words.hpp"

namespace azimuth {
CameraSource::CameraSource(const CameraDriverSettings& settings, StreamOpener open, Duration to_stamp, UsbHelp usb)
    : to_stamp_(to_stamp),
      opener_(std::move(open)),
      driver_(settings, [this] { return opener_.open(); }),
      usb_(std::move(usb)) {}

void CameraSource::work(Clock::time_point now, SourceWires& wires) {
  if (usb_.turn()) driver_.wake(now);
  driver_.turn(now);
  help(now);
  pass_on(wires);
}

PolledSource::Polled CameraSource::polled() const {
  return {pollfd{.fd = driver_.descriptor(), .events = driver_.poll_events(), .revents = 0}, usb_.polled()};
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
    frame_ = Frame{};  // releases an unwanted frame, or the frame that publish() replaced
  }
}

void CameraSource::tell(EventRelay& relay, bool trouble, SourceWires& wires) {
  relay.pass_on(driver_, trouble, "camera: ", wires);
  relay.pass_on(usb_, "camera: ", wires);
}

void CameraSource::describe(DeviceStatus& status) const {
  const CameraState& state = driver_.state();
  const FrameFormat& format = state.description.format;
  put_state(state, status.text);
  if (state.connection == Connection::running)
    fmt::format_to(std::back_inserter(status.text), " ({}, {} {}x{})", state.description.device,
                   azimuth::name(format.pixels), format.width_px, format.height_px);
  append_losses({{state.missing, "missing"},
                 {state.corrupt, "corrupt"},
                 {state.stamps_replaced, "with a stamp replaced"},
                 {state.stamps_dropped, "dropped for their stamp"}},
                status.text);
  status.reconnects = state.reopenings();
  status.port_resets = usb_.resets();
  status.images_missing = state.missing;
  status.images_corrupt = state.corrupt;
}

}  // namespace azimuth
