#pragma once
#include <array>
#include <optional>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

/// What a filter's innovations have told of the constants that it considers.
struct RigTold {
  /// Errors of the rig and their standard deviations, from the innovations and the prior. The prior is the rig's sigma
  /// or, where the innovations contradict the rig, the typical error of a wrong rig.
  Considered mean = Considered::Zero(), sigma = Considered::Zero();
  std::array<bool, considered::kCount> doubted{};
  /// Remaining variances of the errors, once the doubted ones are corrected for. For an error that is not doubted it
  /// includes the size that the innovations indicate, weighted by the probability that the rig is wrong.
  Considered left = Considered::Zero();

  bool is_doubted(int which) const { return doubted[static_cast<std::size_t>(which)]; }
  bool doubts_any() const;
  /// The errors to correct for: those that are doubted.
  Considered believable() const;
};

/// The errors are (A + prior^-1)^-1 b, with A and b from JointState::Told: Friedland's estimate of a bias beside a
/// filter that does not model it. The rig is tested for contradictions as in the smoother (mathematics VI.33, VI.35),
/// one constant after the other, the most contradicted first, since one wrong constant makes others seem wrong. A
/// constant that is already corrected for stays in doubt until its error is less likely than the rig.
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
