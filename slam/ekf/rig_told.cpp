#include "slam/ekf/rig_told.hpp"

#include <array>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kExact = 0.0;
/// Standard deviations of a wrong rig's errors. Zero for the scale of distance, which bearings do not observe.
Considered if_wrong() {
  Considered sigma = Considered::Constant(kExact);
  sigma(considered::scale_turn) = wrong_rig::kScaleTurn;
  sigma(considered::lag) = wrong_rig::kLag_s;
  sigma(considered::drift) = wrong_rig::kDrift_rad_per_m;
  sigma(considered::yaw) = wrong_rig::kYaw_rad;
  sigma.segment<2>(considered::camera).setConstant(wrong_rig::kCamera_m);
  return sigma;
}

}  // namespace

RigTold told_of_rig(const JointState& state) {
  static const Considered kIfWrong = if_wrong();
  std::array<bool, considered::kCount> corrected{};
  for (int i = 0; i < considered::kCount; ++i) corrected[static_cast<std::size_t>(i)] = state.believed()(i) != 0.0;
  return judged<considered::kCount>(state.told_of_considered(), state.considered(), kIfWrong, corrected,
                                    kCertainOfRig_sigmas);
}

/// Removes the prior of the lag from the posterior.
std::optional<LagFound> lag_found(const JointState& state, const RigTold& rig) {
  if (state.considered()(considered::lag) <= kExact) return std::nullopt;
  const double known = rig.is_doubted(considered::lag) ? 1.0 / (wrong_rig::kLag_s * wrong_rig::kLag_s)
                                                       : 1.0 / state.considered()(considered::lag);
  const double variance_s2 = rig.sigma(considered::lag) * rig.sigma(considered::lag);
  const double told = 1.0 / variance_s2 - known;
  if (!(told > 0.0) || !std::isfinite(told)) return std::nullopt;
  return LagFound{rig.mean(considered::lag) / variance_s2 / told, 1.0 / std::sqrt(told)};
}

}  // namespace azimuth
