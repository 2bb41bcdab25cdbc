#include "daemon/devices/shared_camera_source.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Longest sleep: the thread beats at least this often.
constexpr auto kNap = 100ms;

}  // namespace

SharedCameraSource::SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic)
    : socket_(socket.string()), epoch_minus_monotonic_(epoch_minus_monotonic), camera_(std::move(socket)) {
  set_.bearings.reserve(kTypicalBearings);
}

bool SharedCameraSource::turn(Doorbell& bell, SourceWires& wires) {
  camera_.turn(SharedCamera::Clock::now());
  while (camera_.take(set_)) {
    set_.stamp += epoch_minus_monotonic_;
    wires.bearings.push(set_);
  }
  report(wires);
  const auto until_due = camera_.next_turn() - SharedCamera::Clock::now();
  bell.wait_also(camera_.descriptor(), POLLIN, std::min<std::chrono::nanoseconds>(kNap, until_due));
  return true;
}

/// When the connection comes or goes, and once at the start.
void SharedCameraSource::report(SourceWires& wires) {
  const SharedCameraState& state = camera_.state();
  if (told_ && state.connected == was_connected_) return;
  told_ = true;
  was_connected_ = state.connected;
  status_.works = state.connected;
  status_.text = state.connected ? "running (" + socket_ + ')' : socket_ + ' ' + state.error;
  status_.reconnects = state.connections > 0 ? state.connections - 1 : 0;
  DeviceEvent event{!state.connected, fmt::format("camera: {}", status_.text)};
  wires.events.push(event);
  DeviceStatus news = status_;
  wires.status.publish(news);
}

}  // namespace azimuth
