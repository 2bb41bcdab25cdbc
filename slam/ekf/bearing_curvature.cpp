// BearingEkf: second-order terms that its rows leave out.

#include <cmath>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/ekf/curvature.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Second moment of across times along. Only position and landmark contribute: the azimuth is linear in the heading.
template <int LandmarkSize>
double curvature_rad2(const JointState& state, const MappedSighting& sighting,
                      const PredictedBearing<LandmarkSize>& predicted, const Stretch<LandmarkSize>& stretch) {
  constexpr auto kSize = as_size(LandmarkSize);
  ObservationRow across, along;
  across.add(sighting.pose, {predicted.by_pose.data(), 2});
  across.add(sighting.landmark, {predicted.by_landmark.data(), kSize});
  along.add(sighting.pose, {stretch.by_position.data(), 2});
  along.add(sighting.landmark, {stretch.by_landmark.data(), kSize});
  return variance_of_product(state, across, along);
}

/// Second moment of d(rho) d(anchor - p), the part across m.
double curvature_of_ray_rad2(const JointState& state, const MappedSighting& sighting, const InverseDepth& ray) {
  const Eigen::Vector2d m = ray.inverse_distance_per_m * (ray.anchor - state.position(sighting.pose)) + ray.direction();
  const Eigen::Vector2d across = Eigen::Vector2d(-m.y(), m.x()) / m.squaredNorm(), against = -across;
  ObservationRow shift, inverse_distance;
  shift.add(sighting.landmark, {across.data(), 2});
  shift.add(sighting.pose, {against.data(), 2});
  const double one = 1.0;
  inverse_distance.add(sighting.landmark + 3, {&one, 1});
  return variance_of_product(state, shift, inverse_distance);
}

}  // namespace

double BearingEkf::camera_curvature_rad2(double camera_azimuth_rad, double radius_px) const {
  if (!offsets_.errors_block || std::isnan(radius_px)) return 0.0;
  const auto [mean, covariance] = *camera_errors();
  const auto [p_px, by_camera] = centred(camera_azimuth_rad, radius_px, mean, offsets_.profile);
  return curvature_by_centre_rad2(p_px, by_camera * covariance * by_camera.transpose(), CameraOffsets::kNearCentre_px);
}

double BearingEkf::curvature_rad2(const MappedSighting& sighting) const {
  if (!settings_.charge_curvature) return 0.0;
  const double by_camera = camera_curvature_rad2(sighting.azimuth_rad, sighting.radius_px);
  const Pose2 T_map_body = state_.pose(sighting.pose);
  if (sighting.kind == BlockKind::point) {
    const Eigen::Vector2d p_map_landmark = state_.position(sighting.landmark);
    const auto predicted = predict_bearing(T_map_body, p_map_landmark, settings_.min_distance_m);
    if (!predicted) return by_camera;
    return by_camera + azimuth::curvature_rad2(state_, sighting, *predicted, stretch(T_map_body, p_map_landmark));
  }
  const InverseDepth seen_along = ray(sighting.landmark);
  const auto predicted = predict_bearing(T_map_body, seen_along, settings_.min_distance_m);
  if (!predicted) return by_camera;
  return by_camera + azimuth::curvature_rad2(state_, sighting, *predicted, stretch(T_map_body, seen_along)) +
         curvature_of_ray_rad2(state_, sighting, seen_along);
}

}  // namespace azimuth
