#pragma once
#include <optional>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

/// How much earlier than stamped images are taken, as far as the innovations since the start tell.
struct LagFound {
  double mean_s = 0.0;
  double sigma_s = 0.0;
};

/// What a filter's innovations have told of the lag, the odometer's scales being as uncertain as the state considers
/// them and nothing being known of the lag beforehand: the lag is off by (A + prior^-1)^-1 b with what JointState::Told
/// says, which is Friedland's estimate of a bias beside a filter that does not know of it. Nullopt while nothing has
/// been told, and where the scales are taken for exact: then nothing is considered.
std::optional<LagFound> lag_found(const JointState& state);

}  // namespace azimuth
