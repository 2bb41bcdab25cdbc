#pragma once
// The standard cameras of a simulated robot, described as in rig.toml.

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "slam/estimator/rig.hpp"

namespace azimuth {

/// "mirror": a hyperbolic mirror 1 m above the floor, 1024 x 768, for coloured landmarks.
/// "fisheye": an upward fisheye at 1.8 m, 1024 x 768, for lamps.
std::optional<CameraRig> standard_camera(std::string_view name);
inline constexpr std::array<std::string_view, 2> kStandardCameras{"mirror", "fisheye"};

/// The camera `rig` with an image of `factor` times the size, rounded to whole pixels.
CameraRig scaled(CameraRig rig, double factor);

/// The camera's part of rig.toml, including the front end.
std::string image_camera_toml(const CameraRig& rig);

}  // namespace azimuth
