#pragma once
#include <array>
#include <optional>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

/// What a filter's innovations have told of the constants that it considers.
struct RigTold {
  /// Errors of the rig and their standard deviations, by what the innovations say and what was known before: to the
  /// rig's sigma, or, where the innovations contradict that, to what a wrong rig is off by.
  Considered mean = Considered::Zero(), sigma = Considered::Zero();
  std::array<bool, considered::kCount> doubted{};
  /// Variances of what is left of the errors where those that are doubted are allowed for. Before they are, the rig may
  /// be wrong by as much as the innovations say, by the odds that it is.
  Considered left = Considered::Zero();

  bool is_doubted(int which) const { return doubted[static_cast<std::size_t>(which)]; }
  bool doubts_any() const;
  /// Errors to allow for: those that are doubted.
  Considered believable() const;
};

/// The errors are (A + prior^-1)^-1 b with what JointState::Told says, which is Friedland's estimate of a bias beside a
/// filter that does not know of it. The rig is contradicted as in the smoother (SPEC VI.33, VI.35), one constant after
/// the other, the most contradicted first: one that is off makes others seem so. What is allowed for already stays in
/// doubt until it is less likely than the rig.
RigTold told_of_rig(const JointState& state);

/// How much earlier than stamped images are taken, as far as the innovations since the start tell.
struct LagFound {
  double mean_s = 0.0;
  double sigma_s = 0.0;
};

/// Likewise of the lag alone, nothing being known of it beforehand and the rest as in `rig`. Nullopt while nothing has
/// been told, and where all is taken for exact: then nothing is considered.
std::optional<LagFound> lag_found(const JointState& state, const RigTold& rig);

}  // namespace azimuth
