#include <cmath>

#include "slam/estimator/ekf_estimator.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

namespace {

constexpr double kUngatedSigmas = 3.0;  // shown where nothing is gated

}  // namespace

/// h(x) and the innovation's gate, S = H P H^T + R (SPEC I.6, I.7), for a bearing of the rig's own noise.
void EkfEstimator::expect(std::vector<ExpectedBearing>& out) const {
  const double sigmas = settings_.gate_chi2 > 0.0 ? std::sqrt(settings_.gate_chi2) : kUngatedSigmas;
  out.clear();
  for (const Landmark& landmark : landmarks_) {
    const MappedSighting straight_ahead = sighting_of(landmark, Bearing{});
    const auto row = ekf_.linearise(straight_ahead);
    if (!row) continue;
    const double variance_rad2 = ekf_.prediction_covariance(*row, *row) + straight_ahead.variance_rad2;
    out.push_back({.landmark = landmark.id,
                   .kind = landmark.kind,
                   .azimuth_rad = wrap(-row->innovation),
                   .gate_rad = sigmas * std::sqrt(variance_rad2)});
  }
}

}  // namespace azimuth
