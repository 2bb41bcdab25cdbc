#pragma once
// What a drive says of how its camera leans.

#include <optional>

#include "slam/camera/camera_model.hpp"
#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

struct TiltCalibration {
  CameraTilt tilt;           ///< of the camera; the rig's, where `contradicts` is false
  double sigma_rad = 0.0;    ///< of roll and of pitch, the larger one
  bool told = false;         ///< else the drive hardly says anything of it
  bool contradicts = false;  ///< the drive says surely that the rig is wrong
};

/// Of a drive whose azimuths were levelled by the tilt of the rig, from a solution that has the right hand. Azimuths
/// alone tell it, since a tilt turns them the more the higher or lower things are seen, which the camera's model says
/// by their radii (SPEC VI.34). Where the image's centre is, and what free_heading() has, is found along with it.
/// Nothing: azimuths do not come from images, or the model says nothing of elevations.
std::optional<TiltCalibration> calibrate_tilt(const Drive& drive, const DriveSolution& solution,
                                              const HindsightSettings& settings);

/// Where a camera that leans by that much more than its image was levelled by sees what `bearing` is of. Of bearings
/// without a radius nobody knows.
Bearing relevelled(const Bearing& bearing, const CameraModel& upright, const CameraTilt& by);

}  // namespace azimuth
