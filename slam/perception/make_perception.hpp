#pragma once
#include <memory>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/perception.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// The settings of all image front ends; one of them is used.
struct PerceptionSettings {
  ColourSettings colour;
  SiftSettings sift;
  LampSettings lamps;
};

/// The front end that finds bearings in the images of a rig's camera, those in which ImageWatch finds trouble left out.
/// Null for `bearings`, which come ready made.
std::unique_ptr<Perception> make_perception(FrontEnd front_end, const CameraRig& rig,
                                            const PerceptionSettings& settings);

/// What compressed images are to be decoded to for a front end: gray8 where brightness is all it uses, else rgb8.
PixelFormat decoded_format(FrontEnd front_end);

}  // namespace azimuth
