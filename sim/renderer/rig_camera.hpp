#pragma once
#include <optional>
#include <string>

#include "sim/renderer/renderer.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {

/// The camera that rig.toml describes: model, mask, height and yaw. Returns nullopt, and the reason in `problem`, if
/// the rig describes no image camera or its parameters are not valid.
std::optional<RenderCamera> render_camera_of(const CameraRig& rig, std::string& problem);

}  // namespace azimuth
