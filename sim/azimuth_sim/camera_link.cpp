#include "sim/azimuth_sim/camera_link.hpp"

#include <utility>

namespace azimuth::sim {

FileResult<CameraLink> CameraLink::listen(const std::filesystem::path& path, std::unique_ptr<FrameSource> frames) {
  FileResult<CameraServer> server =
      frames ? CameraServer::listen(path, {.format = frames->format()}) : CameraServer::listen_for_bearings(path);
  if (!server) return server.errors();
  return CameraLink(*std::move(server), std::move(frames));
}

void CameraLink::send(const SimulationOutput& output, const PacedClock& clock) {
  for (const BearingSet& set : output.bearings) {
    set_ = set;
    set_.stamp = clock.monotonic_stamp(set.stamp);
    server_.send(set_);
  }
  if (!frames_) return;
  for (const FrameInstant& instant : output.frames) {
    const std::span<std::byte> pixels = server_.next_frame();
    if (pixels.empty()) continue;  // nobody is there, or slow; the gap in the sequence tells
    frames_->render(instant.T_world_body, pixels);
    server_.send_frame(clock.monotonic_stamp(instant.stamp));
  }
}

}  // namespace azimuth::sim
