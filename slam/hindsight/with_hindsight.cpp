#include "slam/hindsight/with_hindsight.hpp"

#include <algorithm>
#include <cmath>

#include "slam/ekf/camera_offsets.hpp"
#include "slam/geometry/index.hpp"
#include "slam/hindsight/graph_map.hpp"

namespace azimuth {
namespace {

constexpr int kEstablished = 3;

/// The azimuth corrected for the camera's `errors`.
double corrected(const Bearing& bearing, const Eigen::Vector4d& errors, const std::optional<CameraModel>& camera) {
  if (std::isnan(bearing.radius_px) || errors.isZero(0.0)) return bearing.azimuth_rad;
  const std::optional<RadialProfile> profile = camera ? std::optional(camera->profile()) : std::nullopt;
  const Eigen::Vector2d pixel = centred(bearing.azimuth_rad, bearing.radius_px, errors, profile).p_px;
  const bool is_near = pixel.norm() < CameraOffsets::kNearCentre_px;
  return is_near ? bearing.azimuth_rad : std::atan2(pixel.y(), pixel.x());
}

}  // namespace

WithHindsight::WithHindsight(std::unique_ptr<Estimator> filter, const Rig& rig, const KnownNamesSettings& settings,
                             double sigma_scale_distance)
    : directions_(rig),
      yaw_offset_rad_(rig.camera.yaw_offset_rad),
      camera_height_m_(rig.camera.image.viewpoint_height_m.value_or(kUnknownHeight_m)),
      filter_(std::move(filter)),
      settings_(settings),
      sigma_scale_distance_(sigma_scale_distance),
      mapper_({settings}, kEstablished) {}

void WithHindsight::predict(const Motion& motion) {
  filter_->predict(motion);
  motions_.push_back(motion);
}

void WithHindsight::update(const BearingSet& bearings) {
  filter_->update(bearings);
  said_.landmarks.clear();
  said_.accepted.clear();
  filter_->estimate(said_);
  Image& image = images_.emplace_back();
  image.motions.swap(motions_);
  image.accepted.stamp = bearings.stamp;
  for (const AcceptedSighting& sighting : said_.accepted) {
    Bearing& bearing = image.accepted.bearings.emplace_back();
    bearing.azimuth_rad = sighting.azimuth_rad;
    bearing.identity = sighting.landmark_id;
    bearing.sigma_rad = sighting.sigma_rad;
    bearing.radius_px = sighting.radius_px;
    bearing.elevation_rad = sighting.elevation_rad;
    bearing.sigma_elevation_rad = sighting.sigma_elevation_rad;
    follows_camera_ = follows_camera_ || !std::isnan(sighting.radius_px) || !std::isnan(sighting.elevation_rad);
  }
  const bool is_lost = said_.health == Health::lost;
  if (was_lost_ && !is_lost) image.found = {said_.T_map_body, said_.pose_covariance};
  was_lost_ = is_lost;
  concluded_ = false;
  add(image);
}

void WithHindsight::add(const Image& image) {
  for (const Motion& motion : image.motions) mapper_.predict(motion);
  if (image.found) mapper_.place(*image.found);
  seen_.stamp = image.accepted.stamp;
  seen_.bearings.clear();
  for (const Bearing& bearing : image.accepted.bearings) seen_.bearings.push_back(in_robot_frame(bearing));
  mapper_.update(seen_);
  image_poses_.add(seen_.stamp, mapper_);
}

/// The bearing in the robot's frame, by the camera calibration found so far.
Bearing WithHindsight::in_robot_frame(const Bearing& seen) const {
  Bearing bearing = seen;
  if (std::isnan(seen.elevation_rad)) {
    bearing.azimuth_rad = wrap(corrected(seen, camera_errors_, directions_.camera()) + yaw_offset_rad_);
    return bearing;
  }
  const Eigen::Vector2d m = directions_.seen(seen, camera_errors_).direction.offset_per_metre();
  bearing.azimuth_rad = std::atan2(m.y(), m.x());
  bearing.elevation_rad = std::atan2(1.0, m.norm());
  return bearing;
}

void WithHindsight::conclude() {
  if (const auto camera = filter_->camera_errors(); camera && follows_camera_) {
    camera_errors_ = camera->mean;
    mapper_ = NamedMapper({settings_}, kEstablished);
    image_poses_ = {};
    for (const Image& image : images_) add(image);
  }
  mapper_.conclude();
  concluded_ = true;
}

/// The graph's landmark that has this id in the filter; null when it has too few bearings or no finite position.
const HindsightLandmark* WithHindsight::settled(std::int64_t id) const {
  const auto found = std::ranges::find(mapper_.landmarks(), id, &HindsightLandmark::identity);
  if (found == mapper_.landmarks().end() || found->sightings < as_size(kEstablished)) return nullptr;
  return mapper_.smoother().graph().landmark(found->in_graph).is_point() ? &*found : nullptr;
}

void WithHindsight::estimate(Estimate& out) const {
  filter_->estimate(out);
  if (!concluded_) return;
  std::erase_if(out.landmarks, [&](const LandmarkEstimate& landmark) { return settled(landmark.id) == nullptr; });
  for (LandmarkEstimate& landmark : out.landmarks) tell_place(landmark);
}

void WithHindsight::tell_place(LandmarkEstimate& landmark) const {
  const Smoother& smoother = mapper_.smoother();
  const LandmarkId in_graph = settled(landmark.id)->in_graph;
  landmark.p_map_landmark_m = smoother.graph().landmark(in_graph).p_map();
  landmark.covariance_m2 =
      smoother.point_covariance(in_graph) + by_scale(sigma_scale_distance_, landmark.p_map_landmark_m);
  if (smoother.graph().elevations_of(in_graph) == 0) return;
  const double height_m = smoother.graph().height_m(in_graph), by_scale_m = sigma_scale_distance_ * height_m;
  landmark.z_map_landmark_m = camera_height_m_ + height_m;
  landmark.sigma_z_m = std::sqrt(smoother.point_covariance_with_height(in_graph)(2, 2) + by_scale_m * by_scale_m);
}

bool WithHindsight::save_map(MapSnapshot& out) const {
  if (!filter_->save_map(out)) return false;
  if (!concluded_ || std::ranges::any_of(out.landmarks, &MapLandmark::has_height)) return true;
  std::erase_if(out.landmarks, [&](const MapLandmark& landmark) { return settled(landmark.id) == nullptr; });
  std::erase_if(out.views, [&](const MapView& view) {
    return std::ranges::find(out.landmarks, view.identity, &MapLandmark::identity) == out.landmarks.end();
  });
  std::vector<LandmarkId> in_graph;
  for (const MapLandmark& landmark : out.landmarks) in_graph.push_back(settled(landmark.id)->in_graph);
  return !in_graph.empty() && place_by_graph(mapper_, in_graph, out);
}

bool WithHindsight::write_past(std::vector<PastPose>& out) const {
  image_poses_.write(mapper_, out);
  for (PastPose& past : out)
    past.covariance.topLeftCorner<2, 2>() += by_scale(sigma_scale_distance_, past.T_map_body.position());
  return true;
}

bool WithHindsight::write_path(std::vector<PathPose>& out) const {
  image_poses_.write_path(mapper_, out);
  return true;
}

}  // namespace azimuth
