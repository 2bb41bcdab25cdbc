#pragma once
#include <optional>
#include <string>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The centre and azimuth mapping of the image. If the rig gives no centre, the middle of the image is used, provided
/// that its size is known.
ImageAxes axes_of(const ImageRig& image);

CameraTilt tilt_of(const CameraRig& rig);

/// Standard deviation of the tilt: the rig's value or, if it gives none, that of a camera mounted by eye. 0 for a model
/// without elevations.
double sigma_tilt_rad(const CameraRig& rig);

MaskShape mask_of(const ImageRig& image);

/// Whether images of this format have the rig's image size, for which directions are computed. True if the rig gives no
/// size.
bool is_size_of(const FrameFormat& format, const ImageRig& image);

/// The camera with its mirror or lens profile. Returns nullopt and the reason in `problem` if the model has no
/// elevations ("bearings", "radial") or its parameters are not valid.
std::optional<CameraModel> camera_of(const CameraRig& rig, std::string& problem);

}  // namespace azimuth
