#include "sim/azimuth_sim/rendered_frames.hpp"

#include <stdexcept>

#include "sim/renderer/standard_cameras.hpp"
#include "sim/world/run_of.hpp"

namespace azimuth::sim {
namespace {

constexpr double kLampHeight_m = 6.5;

CameraRig rig_of(const Scenario& scenario, const ImageSettings& settings) {
  std::optional<CameraRig> rig = standard_camera(settings.camera);
  if (!rig) throw std::invalid_argument("no camera is called " + settings.camera);
  rig->yaw_offset_rad = scenario.sensor.yaw_offset_rad;
  return scaled(*std::move(rig), settings.scale);
}

RenderCamera camera_of(const Scenario& scenario, const ImageSettings& settings) {
  std::string problem;
  std::optional<RenderCamera> camera = azimuth::render_camera_of(rig_of(scenario, settings), problem);
  if (!camera) throw std::invalid_argument(settings.camera + ": " + problem);
  camera->sensor = {.noise = settings.noise,
                    .vignetting = 0.25,
                    .vignetting_radius_px = 376.0 * settings.scale,
                    .seed = scenario.seed};
  return *camera;
}

RenderScene scene_of(const Scenario& scenario, const ImageSettings& settings) {
  return settings.camera == "fisheye" ? lamp_scene(scenario, kLampHeight_m) : coloured_scene(scenario);
}

}  // namespace

RenderedFrames::RenderedFrames(const Scenario& scenario, const ImageSettings& settings)
    : period_(duration_from_seconds(1.0 / settings.rate_hz)),
      renderer_(scene_of(scenario, settings), camera_of(scenario, settings)) {
  const RenderCamera camera = camera_of(scenario, settings);
  format_ = packed_format(settings.pixels, camera.width_px, camera.height_px);
}

std::unique_ptr<FrameSource> make_frames(const Scenario& scenario, const std::optional<ImageSettings>& settings) {
  return settings ? std::make_unique<RenderedFrames>(scenario, *settings) : nullptr;
}

std::string image_rig_toml(const Scenario& scenario, const ImageSettings& settings) {
  return rig_toml(scenario, image_camera_toml(rig_of(scenario, settings)));
}

}  // namespace azimuth::sim
