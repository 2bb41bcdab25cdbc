#pragma once
// The cameras that a simulated robot can carry, described as in rig.toml.

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

/// The same camera with an image of `factor` times the size, whole pixels at least: what sees the same in other pixels.
CameraRig scaled(CameraRig rig, double factor);

/// The camera's part of rig.toml, with front end: what a daemon needs to know to read the images.
std::string image_camera_toml(const CameraRig& rig);

}  // namespace azimuth
