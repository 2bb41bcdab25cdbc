#pragma once
// A fisheye's lens from the lamps that it sees on a drive.

#include <optional>
#include <string>

#include "slam/perception/lamps/lamp_settings.hpp"
#include "tools/lens_fit/lamp_tracking.hpp"
#include "tools/lens_fit/lens_start.hpp"

namespace azimuth {

struct FisheyeCalibration {
  LensDrive drive;
  LensSolution solution;
  bool tilt_found = false;      ///< else the lens leans as the rig says, which the drive does not contradict
  bool height_known = false;    ///< else the lens's scale is the one it began with
  double theta_seen_rad = 0.0;  ///< how far from the axis lamps were seen that fit
  double theta_max_rad = 0.0;   ///< the lens is given up to here: no farther, and as far as it grows
  Rig rig;                      ///< as it was, with that lens
};

/// Looks at all images some times over, each time with the better lens. Nothing, and in `problem` one sentence that
/// says why, when the drive cannot tell. Deterministic.
std::optional<FisheyeCalibration> calibrate_fisheye(const Run& run, const Rig& rig, const LampSettings& settings,
                                                    const FisheyeRequest& request, std::string& problem);

/// Why sightings in that number and place do not tell a lens; empty: they may.
std::string why_cannot_tell(const LensFitStart& map);
std::string why_cannot_tell(const LensSolution& solution, double theta_seen_rad);

}  // namespace azimuth
