#pragma once
#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

/// The smoother as an estimator (SPEC VI.18 to VI.20): what it takes from the rig is not here.
struct HindsightSettings {
  bool names = true;  ///< believe the names that the rig's bearings carry; false: as if they carried none
  /// What the rig says of odometer and camera is believed as well as it says until the drive contradicts it, and noise
  /// is what bearings and odometry show, where landmarks have names; false: the rig is always believed.
  bool doubt_rig = true;
  /// Its scale of distance, which no bearing tells, may be off by the rig's sigma_scale_distance; false: it is exact.
  bool consider_distance = true;

  // Which bearings are used (SPEC part V)
  double thinning_s = 0.5;           ///< at most one bearing of a named landmark in this time
  double nameless_thinning_s = 0.4;  ///< of bearings without names, at most one image in this time
  int replant_after = 5;             ///< misfits in a row after which a named landmark is looked for anew; 0: never
  int confirm_after_bearings = 3;    ///< a landmark of fewer is not published

  // Landmarks seen for the first time
  double inverse_depth_mean_per_m = 0.1;
  double inverse_depth_sigma_per_m = 0.5;

  // How far bearings that fit badly are listened to
  RobustKernel kernel = RobustKernel::cauchy;  ///< of named landmarks; hypotheses differ in theirs
  double kernel_width = 3.0;                   ///< standard deviations

  /// Of named landmarks, a second member goes beside that listens less to bearings that fit badly; the one with the
  /// lower energy speaks.
  bool several = true;

  int max_iterations = 4;  ///< of the solution, for each image

  // Long drives
  /// Of more poses with bearings those are forgotten that are worth least, unless landmarks need them; 0: none.
  int max_keyframes = 1500;
  int nameless_max_keyframes = 300;  ///< likewise, of bearings without names, for each hypothesis

  int members = 0;  ///< hypotheses followed side by side where bearings have no names; 0: as many as the view asks for
  int threads = 1;  ///< that look after them, in the daemon; the estimates are the same with any number

  friend bool operator==(const HindsightSettings&, const HindsightSettings&) = default;
};

}  // namespace azimuth
