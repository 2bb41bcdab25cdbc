#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// What a graph takes from the rig, and what a drive makes of it.
///
/// A rig is right, or nearly so, most of the time, and far off now and then: a camera put on by hand, an odometer of
/// another robot's. To take all of that for unknown throughout costs accuracy wherever a drive tells little (a corridor
/// bends as a heading that is off does), so each of the rig's values is believed as well as it says until the drive
/// contradicts it by more than the odds against that, and is an unknown then, known before to `if_wrong` only (SPEC
/// VI.33). Noise is followed both ways.
struct RigBelief {
  Calibration sigma = Calibration::Zero();  ///< of the graph's priors, where calibrations are unknowns
  double bearing_noise = 1.0;               ///< standard deviations, times the rig's
  double odometry_noise = 1.0;
  std::array<bool, kCalibrations> doubted{};
  /// Doubted, and what came of it was no rig: something else is wrong, such as the sense of azimuths. The
  /// rig is believed from then on.
  std::array<bool, kCalibrations> impossible{};

  bool is_doubted(int which) const { return doubted[static_cast<std::size_t>(which)]; }
  bool is_impossible(int which) const { return impossible[static_cast<std::size_t>(which)]; }
  bool is_beyond_repair() const { return std::ranges::any_of(impossible, std::identity{}); }
  bool doubts_any() const { return std::ranges::any_of(doubted, std::identity{}); }
};

struct RigDoubts {
  CalibrationPriors if_wrong;  ///< standard deviations; 0: never doubted
  bool noise = false;          ///< the scatter of bearings and odometry is followed
};

/// What the rig says.
RigBelief rig_belief(const CalibrationPriors& said);

/// What `smoother`, which goes by `belief`, makes of the rig that says `said`. As of its last optimise().
RigBelief judged(const Smoother& smoother, const RigBelief& belief, const RigBelief& said, const RigDoubts& doubts);

/// Goes by `next` from now on: optimise() is to follow. False: nothing has changed.
bool change(Smoother& smoother, const RigBelief& belief, const RigBelief& next);

}  // namespace azimuth
