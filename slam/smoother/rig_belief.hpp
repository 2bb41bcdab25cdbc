#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// The values that a graph takes from the rig (the robot's configured calibration and noise), and their adaptation to
/// the drive.
///
/// A rig is usually right or nearly so, and sometimes far off, for instance with a camera mounted by hand or the
/// odometer of another robot. Wide priors throughout would cost accuracy wherever a drive has little information: a
/// heading error looks like a bent corridor. Therefore each value keeps the narrow prior that the rig states until the
/// evidence of the drive against the value exceeds kLogOddsToDoubt. The value then gets the wide prior
/// RigDoubts::if_wrong (mathematics VI.33). The noise is adapted upwards and downwards.
struct RigBelief {
  Calibration sigma = Calibration::Zero();  ///< prior standard deviations of the calibrated values
  double bearing_noise = 1.0;               ///< factor on the rig's standard deviations
  double odometry_noise = 1.0;
  std::array<bool, kCalibrations> doubted{};
  /// The value was doubted, and its estimate was then impossible for a rig. Something else is wrong, such as the sense
  /// of rotation of azimuths. The whole rig is believed from then on.
  std::array<bool, kCalibrations> impossible{};

  bool is_doubted(int which) const { return doubted[static_cast<std::size_t>(which)]; }
  bool is_impossible(int which) const { return impossible[static_cast<std::size_t>(which)]; }
  bool is_beyond_repair() const { return std::ranges::any_of(impossible, std::identity{}); }
  bool doubts_any() const { return std::ranges::any_of(doubted, std::identity{}); }
};

struct RigDoubts {
  CalibrationPriors if_wrong;  ///< prior standard deviations of a wrong value; 0: never doubted
  bool noise = false;          ///< whether the noise of bearings and odometry is adapted
};

/// The initial belief: the rig's own values.
RigBelief rig_belief(const CalibrationPriors& said);

/// The rig belief that the measurements suggest. `smoother` uses `belief` now, and `said` is the rig's own belief. The
/// result is as of the smoother's last optimise().
RigBelief judged(const Smoother& smoother, const RigBelief& belief, const RigBelief& said, const RigDoubts& doubts);

/// Switches the smoother from `belief` to `next`; the caller must call optimise() afterwards. Returns false when
/// nothing has changed.
bool change(Smoother& smoother, const RigBelief& belief, const RigBelief& next);

}  // namespace azimuth
