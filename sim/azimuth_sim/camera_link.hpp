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

/// Hands the simulated camera's bearings, and images if there is a source of them, to a client of the camera link.
///
/// Thread contract: thread-bound.
class CameraLink {
 public:
  /// `frames` may be null.
  static FileResult<CameraLink> listen(const std::filesystem::path& path, std::unique_ptr<FrameSource> frames);

  int descriptor() const { return server_.descriptor(); }
  /// Sees to the client, and goes on with the image that is being made.
  void turn();
  /// An image is being made: turn() should come again at once.
  bool busy() const { return !pixels_.empty(); }
  /// Images that fall due while another one is being made are skipped, as by a slow camera.
  void send(const SimulationOutput& output, const PacedClock& clock);
  const CameraServerCounts& counts() const { return server_.counts(); }

 private:
  void take_image(const FrameInstant& instant, const PacedClock& clock);
  CameraLink(CameraServer server, std::unique_ptr<FrameSource> frames)
      : server_(std::move(server)), frames_(std::move(frames)) {}

  CameraServer server_;
  std::unique_ptr<FrameSource> frames_;
  BearingSet set_;
  std::span<std::byte> pixels_;  // of the image being made
  Stamp frame_stamp_{};          // and when it was taken, on CLOCK_MONOTONIC
};

}  // namespace azimuth::sim
