#pragma once
#include <optional>
#include <string>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The centre and the azimuths of the image. Missing centre: of the middle of the image if its size is known.
ImageAxes axes_of(const ImageRig& image);

CameraTilt tilt_of(const CameraRig& rig);

/// What the rig leaves unknown of that: what it says or, where it is silent, how well a camera is mounted by eye. 0 of
/// one that knows nothing of elevations.
double sigma_tilt_rad(const CameraRig& rig);

MaskShape mask_of(const ImageRig& image);

/// Whether images like that are of the rig's size, which directions are worked out for. Any are where it names none.
bool is_size_of(const FrameFormat& format, const ImageRig& image);

/// The camera with its mirror's or lens's shape. Nothing, and why in `problem`, when the rig describes no such camera
/// ("bearings", "radial") or one with parameters that make none.
std::optional<CameraModel> camera_of(const CameraRig& rig, std::string& problem);

}  // namespace azimuth
