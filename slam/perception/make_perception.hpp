#pragma once
#include <memory>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/perception.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// The settings of all image front ends; a run uses one of them.
struct PerceptionSettings {
  ColourSettings colour;
  SiftSettings sift;
  LampSettings lamps;
};

/// Makes the front end that finds bearings in the images of the rig's camera. The front end skips images in which
/// ImageWatch finds trouble. Returns null for FrontEnd::bearings, whose bearings need no image processing.
std::unique_ptr<Perception> make_perception(FrontEnd front_end, const CameraRig& rig,
                                            const PerceptionSettings& settings);

/// The pixel format to which compressed images must be decoded for a front end: gray8 if the front end uses only
/// brightness, else rgb8.
PixelFormat decoded_format(FrontEnd front_end);

}  // namespace azimuth
