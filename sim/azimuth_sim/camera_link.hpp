#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "drivers/camera/camera_server.hpp"
#include "sim/azimuth_sim/frame_source.hpp"
#include "sim/azimuth_sim/paced_clock.hpp"
#include "sim/azimuth_sim/simulation.hpp"

namespace azimuth::sim {

/// Sends the simulated camera's bearings, and images if there is a frame source, to a client of the camera link.
///
/// Thread contract: thread-bound.
class CameraLink {
 public:
  /// `frames` may be null.
  static FileResult<CameraLink> listen(const std::filesystem::path& path, std::unique_ptr<FrameSource> frames);

  int descriptor() const { return server_.descriptor(); }
  /// Serves the client, and continues the image in progress.
  void turn();
  /// Whether an image is in progress. If so, turn() should be called again at once.
  bool busy() const { return !pixels_.empty(); }
  /// Sends the output of the simulation. Images that fall due while another one is in progress are skipped, as by a
  /// slow camera.
  void send(const SimulationOutput& output, const PacedClock& clock);
  const CameraServerCounts& counts() const { return server_.counts(); }

 private:
  void take_image(const FrameInstant& instant, const PacedClock& clock);
  CameraLink(CameraServer server, std::unique_ptr<FrameSource> frames)
      : server_(std::move(server)), frames_(std::move(frames)) {}

  CameraServer server_;
  std::unique_ptr<FrameSource> frames_;
  BearingSet set_;
  std::span<std::byte> pixels_;  // Buffer of the image in progress
  Stamp frame_stamp_{};          // Instant of that image, on CLOCK_MONOTONIC
};

}  // namespace azimuth::sim
