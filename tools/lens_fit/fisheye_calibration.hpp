#pragma once
// Calibrates the lens of a fisheye camera from the ceiling lamps that it sees on a drive.

#include <optional>
#include <string>

#include "drivers/storage/run.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "tools/lens_fit/lamp_tracking.hpp"
#include "tools/lens_fit/lens_fit.hpp"

namespace azimuth {

/// Values from the command line that the rig does not contain.
struct FisheyeRequest {
  std::optional<double> lamp_height_m;  ///< height of the lamps above the floor; nothing if unknown
  double sigma_lamp_height_m = 0.02;    ///< standard deviation of lamp_height_m
  double sigma_one_lamp_m = 0.02;       ///< standard deviation of a single lamp about lamp_height_m
  /// Full angle of the lens. If given, the fit starts from r = f theta instead of the rig's model.
  std::optional<double> field_of_view_rad;
};

struct FisheyeStart {
  Rig rig;  ///< used for the first detection of lamps
  Lens lens;
  LensPriors priors;
  std::vector<Motion> motions;  ///< one per image, from the previous image
};

/// If the run or the rig is unsuitable, the result is empty and `problem` has one sentence with the reason.
std::optional<FisheyeStart> fisheye_start(const Run& run, const Rig& rig, const FisheyeRequest& request,
                                          std::string& problem);

struct FisheyeCalibration {
  LensDrive drive;
  LensSolution solution;
  bool tilt_found = false;      ///< true if the drive contradicts the rig's tilt; otherwise the rig's tilt is used
  bool height_known = false;    ///< true if the lamp height was given; otherwise the lens keeps its initial scale
  double theta_seen_rad = 0.0;  ///< largest angle from the axis of an observation that fits
  double theta_max_rad = 0.0;   ///< limit of the lens: near theta_seen_rad, where theta still grows with the radius
  Rig rig;                      ///< the input rig with the calibrated lens
};

/// Processes all images several times, each time with the improved lens. If the drive does not determine the lens, the
/// result is empty and `problem` has one sentence with the reason. Deterministic.
std::optional<FisheyeCalibration> calibrate_fisheye(const Run& run, const Rig& rig, const LampSettings& settings,
                                                    const FisheyeRequest& request, std::string& problem);

/// The same for a run of which only `odometry` is known. The lens begins equidistant and sees half of the world. Of the
/// ways in which the camera may be turned on the robot, in steps of 45 degrees, the one through which lamps can be
/// followed best is taken.
std::optional<FisheyeCalibration> calibrate_unknown_fisheye(const Run& run, const OdometryRig& odometry,
                                                            const LampSettings& settings, std::string& problem);

/// The reason why the lamp observations, or the solution, do not determine the lens; empty if they do.
std::string why_cannot_tell(const LensFitStart& map);
std::string why_cannot_tell(const LensSolution& solution, double theta_seen_rad);

}  // namespace azimuth
