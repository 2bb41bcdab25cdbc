#pragma once
// Calibrates the roll and pitch of the camera from a drive.

#include <optional>

#include "slam/camera/camera_model.hpp"
#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

struct TiltCalibration {
  CameraTilt tilt;            ///< tilt of the camera; the rig's own value if `contradicts` is false
  CameraTilt likeliest = {};  ///< tilt that fits the drive best
  double sigma_rad = 0.0;     ///< the larger standard deviation of roll and pitch
  bool told = false;          ///< false if sigma_rad is too large
  bool contradicts = false;   ///< the rig's tilt is surely wrong
};

/// Preconditions: the azimuths of the drive were levelled with the rig's tilt, and `solution` has the right azimuth
/// direction. Azimuths alone determine the tilt: the larger the elevation of a landmark, the more a tilt shifts its
/// azimuth, and the camera model gives the elevation from the radius in the image (mathematics VI.34). The fit also
/// estimates the image centre and the numbers of free_heading(). Nothing if azimuths do not come from images or the
/// camera model gives no elevations.
std::optional<TiltCalibration> calibrate_tilt(const Drive& drive, const DriveSolution& solution,
                                              const HindsightSettings& settings);

/// The bearing as seen by a camera whose tilt exceeds the tilt used for levelling by `by`. A bearing without a radius
/// stays unchanged.
Bearing relevelled(const Bearing& bearing, const CameraModel& upright, const CameraTilt& by);

}  // namespace azimuth
