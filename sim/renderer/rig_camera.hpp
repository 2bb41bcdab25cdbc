#pragma once
#include <optional>
#include <string>

#include "sim/renderer/renderer.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {

/// The camera that rig.toml describes: model, mask, height and yaw. Nothing, and why in `problem`, when it describes no
/// image camera or one with parameters that make none.
std::optional<RenderCamera> render_camera_of(const CameraRig& rig, std::string& problem);

}  // namespace azimuth
