#pragma once
#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

/// Settings of the smoother estimator (mathematics VI.18 to VI.20), besides the values of the rig.
struct HindsightSettings {
  bool names = true;  ///< use the identities of bearings; false: ignore them
  /// Whether the rig's calibration may be contradicted by the drive, and the noise adapted to the residuals. Without
  /// identities, only the camera's yaw may be contradicted. false: the rig is always believed.
  bool doubt_rig = true;
  /// Whether covariances include the rig's sigma_scale_distance, an error that bearings cannot reveal; false: the scale
  /// is taken as exact.
  bool consider_distance = true;

  // Which bearings are used (mathematics part V)
  double thinning_s = 0.5;           ///< at most one bearing per identified landmark in this time
  double nameless_thinning_s = 0.4;  ///< without identities, at most one image in this time
  /// Consecutive misfits after which an identified landmark is initialised anew; 0: never
  int reinitialise_after = 5;
  int confirm_after_bearings = 3;  ///< a landmark with fewer bearings is not published

  // Prior of new landmarks
  double inverse_depth_mean_per_m = 0.1;
  double inverse_depth_sigma_per_m = 0.5;

  // Weight of outliers
  RobustKernel kernel = RobustKernel::cauchy;  ///< with identities; hypotheses have kernels of their own
  double kernel_width = 3.0;                   ///< standard deviations

  /// With identities, whether a second member with a stricter kernel runs in parallel. The member with the lower energy
  /// gives the results.
  bool several = true;

  int max_iterations = 4;  ///< of the optimisation, per image

  // Long drives
  /// Limit on the number of poses (keyframes). Beyond it, the least valuable poses are removed, unless landmarks need
  /// them; 0: no limit.
  int max_keyframes = 1500;
  int nameless_max_keyframes = 300;  ///< the same limit for each hypothesis without identities

  int members = 0;  ///< number of hypotheses without identities; 0: depends on the field of view
  int threads = 1;  ///< number of threads for the hypotheses in the daemon; it does not change the estimates

  friend bool operator==(const HindsightSettings&, const HindsightSettings&) = default;
};

}  // namespace azimuth
