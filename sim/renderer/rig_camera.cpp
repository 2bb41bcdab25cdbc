#include "sim/renderer/rig_camera.hpp"

#include "slam/camera/make_camera.hpp"

namespace azimuth {

std::optional<RenderCamera> render_camera_of(const CameraRig& rig, std::string& problem) {
  const std::optional<CameraModel> model = camera_of(rig, problem);
  if (!model) return std::nullopt;
  RenderCamera camera{.model = *model, .mask = mask_of(rig.image), .T_body_camera = {}, .sensor = {}};
  camera.width_px = rig.image.width_px.value_or(0);
  camera.height_px = rig.image.height_px.value_or(0);
  camera.height_m = rig.image.viewpoint_height_m.value_or(0.0);
  camera.T_body_camera = {rig.position_m[0], rig.position_m[1], rig.yaw_offset_rad};
  return camera;
}

}  // namespace azimuth
