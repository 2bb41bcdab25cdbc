#pragma once
#include <memory>
#include <optional>
#include <string>

#include "sim/azimuth_sim/frame_source.hpp"
#include "sim/renderer/renderer.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth::sim {

struct ImageSettings {
  std::string camera = "mirror";  ///< A name of standard_camera()
  PixelFormat pixels = PixelFormat::rgb8;
  double rate_hz = 15.0;
  double scale = 1.0;  ///< Scale of the image's sides; smaller images render faster
  double noise = 1.5;  ///< Standard deviation of the noise of each sample, in 8-bit steps
};

/// Renders the scenario's landmarks: as coloured cylinders for a mirror, as lamps for a fisheye.
///
/// Thread contract: thread-bound.
class RenderedFrames : public FrameSource {
 public:
  RenderedFrames(const Scenario& scenario, const ImageSettings& settings);

  FrameFormat format() const override { return format_; }
  Duration period() const override { return period_; }
  void begin(const Pose2& T_world_body) override { renderer_.begin(T_world_body); }
  bool step(std::span<std::byte> pixels) override { return renderer_.step({format_, pixels}); }

 private:
  FrameFormat format_;
  Duration period_;
  Renderer renderer_;
};

/// Returns null if `settings` is empty.
std::unique_ptr<FrameSource> make_frames(const Scenario& scenario, const std::optional<ImageSettings>& settings);

/// The rig.toml of a robot with this camera.
std::string image_rig_toml(const Scenario& scenario, const ImageSettings& settings);

}  // namespace azimuth::sim
