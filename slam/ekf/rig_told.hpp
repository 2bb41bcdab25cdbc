#pragma once
#include <optional>

#include "slam/ekf/joint_state.hpp"
#include "slam/geometry/wrong_rig.hpp"

namespace azimuth {

/// What a filter's innovations have told of the constants that it considers.
using RigTold = RigErrors<considered::kCount>;

/// The errors are (A + prior^-1)^-1 b, with A and b from JointState::Told: Friedland's estimate of a bias beside a
/// filter that does not model it.
RigTold told_of_rig(const JointState& state);

/// By how much images are taken earlier than stamped, from the innovations since the start.
struct LagFound {
  double mean_s = 0.0;
  double sigma_s = 0.0;
};

/// Estimates the lag without a prior on the lag, and with the other constants as in `rig`. Nothing while there is no
/// information on the lag, and where the constants count as exact and are not considered.
std::optional<LagFound> lag_found(const JointState& state, const RigTold& rig);

}  // namespace azimuth
