#include "slam/planar/planar_view.hpp"

#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

double PlanarView::variance_rad2(const Bearing& bearing) const {
  const double sigma = sigma_rad(bearing, camera_);
  return sigma * sigma;
}

MappedSighting PlanarView::sighting_of(const PlanarLandmark& landmark, const Bearing& bearing) const {
  return {JointState::kPose,   landmark.block,         landmark.block_kind,
          bearing.azimuth_rad, variance_rad2(bearing), bearing.radius_px};
}

std::optional<PlanarView::Predicted> PlanarView::predict(const PlanarLandmark& landmark) const {
  const auto row = ekf_.linearise(sighting_of(landmark, Bearing{}));
  if (!row) return std::nullopt;
  Bearing seen;
  seen.azimuth_rad = wrap(-row->innovation);
  seen.radius_px = landmark.radius_px;
  const MappedSighting sighting = sighting_of(landmark, seen);
  const auto centred = ekf_.linearise(sighting);
  return Predicted{*centred, wrap(seen.azimuth_rad - centred->innovation),
                   ekf_.prediction_covariance(*centred, *centred) + ekf_.curvature_rad2(sighting)};
}

std::optional<PlanarView::Predicted> PlanarView::predict_straight(const PlanarLandmark& landmark) const {
  const auto row = ekf_.linearise(sighting_of(landmark, Bearing{}));
  if (!row) return std::nullopt;
  return Predicted{*row, wrap(-row->innovation), ekf_.prediction_covariance(*row, *row)};
}

}  // namespace azimuth
