#include "sim/azimuth_sim/camera_link.hpp"

#include <utility>

namespace azimuth::sim {

FileResult<CameraLink> CameraLink::listen(const std::filesystem::path& path, std::unique_ptr<FrameSource> frames) {
  FileResult<CameraServer> server =
      frames ? CameraServer::listen(path, {.format = frames->format()}) : CameraServer::listen_for_bearings(path);
  if (!server) return failure(server.error());
  return CameraLink(*std::move(server), std::move(frames));
}

void CameraLink::send(const SimulationOutput& output, const PacedClock& clock) {
  for (const BearingSet& set : output.bearings) {
    set_ = set;
    set_.stamp = clock.monotonic_stamp(set.stamp);
    server_.send(set_);
  }
  if (!frames_) return;
  for (const FrameInstant& instant : output.frames) take_image(instant, clock);
}

void CameraLink::take_image(const FrameInstant& instant, const PacedClock& clock) {
  if (busy()) return server_.skip_frame();
  pixels_ = server_.next_frame();
  if (!busy()) return;  // There is no client, or it is slow; the gap in the sequence numbers shows this
  frame_stamp_ = clock.monotonic_stamp(instant.stamp);
  frames_->begin(instant.T_world_body);
}

void CameraLink::turn() {
  server_.turn();
  if (!busy() || !frames_->step(pixels_)) return;
  server_.send_frame(frame_stamp_);
  pixels_ = {};
}

}  // namespace azimuth::sim
