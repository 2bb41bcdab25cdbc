// FastSlamEstimator: saving a map, starting from a saved map, and relocalisation in it.

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/index.hpp"
#include "slam/lost/lost_robot.hpp"
#include "slam/particles/fastslam_estimator.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"

namespace azimuth {

std::optional<std::string_view> why_unfit_for_fastslam(const MapSnapshot& map, const Rig& rig,
                                                       const FastSlamSettings& settings) {
  if (!std::ranges::all_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have no heights, and estimator \"fastslam\" maps in space";
  if (map.landmarks.size() > as_size(settings.max_landmarks))
    return "it has more landmarks than a particle's map may have";
  return why_names_do_not_fit(map, rig);
}

void FastSlamEstimator::start_from(const MapStart& start) {
  filter_.restore(*start.map);
  if (start.mode == MapMode::localise) filter_.hold_map();
  if (start.asks_odometry)
    undecided_ = start_pose(start);
  else
    begin_at(start_pose(start));
}

void FastSlamEstimator::begin_at(const StartPose& pose) {
  if (pose.known || filter_.particles()[0].landmarks == 0)
    filter_.disperse(pose.moved);
  else
    begin_search(pose.within);
}

bool FastSlamEstimator::odometry_begins(bool goes_on) {
  const std::optional<StartPose> pose = std::exchange(undecided_, std::nullopt);
  if (pose && !goes_on) begin_at(*pose);
  return pose && goes_on;
}

/// The camera's view for relocalisation.
CameraView FastSlamEstimator::camera_view() const {
  constexpr double kLowest_rad = 1.4;  // zenith angle; lamps beyond it are too far away for relocalisation
  const LampCamera& camera = filter_.camera();
  double highest_m = 0.0;
  for (const Eigen::Vector3d& p_map : filter_.particles().positions(filter_.best()))
    highest_m = std::max(highest_m, p_map.z());
  const double max_zenith_rad = std::min(camera.max_zenith_rad, kLowest_rad);
  CameraView view;
  view.height_m = camera.height_m;
  view.min_elevation_rad = kPi / 2.0 - max_zenith_rad;
  view.rim = inner_margin_;
  view.max_distance_m = std::max(0.0, highest_m - view.height_m) * std::tan(max_zenith_rad);
  view.detection_probability = camera.detection_probability;
  return view;
}

void FastSlamEstimator::begin_search(const std::optional<PositionPrior>& within) {
  const Particles& particles = filter_.particles();
  const std::size_t best = filter_.best();
  std::vector<KnownLandmark> known;
  for (std::size_t slot = 0; slot < particles[best].landmarks; ++slot)
    known.push_back({.p_map_m = particles.positions(best)[slot],
                     .covariance_m2 = particles.covariances(best)[slot].matrix(),
                     .identity = particles.infos(best)[slot].identity});
  relocaliser_.start(known, camera_view(), within);
  filter_.place(filter_.pose(), LostRobot::anywhere());
  searching_ = true;
}

/// Runs relocalisation with the last image. Returns true when the robot was found. The pose then gets a standard
/// deviation of half a metre, so that the update with the image builds the correlation with the map.
bool FastSlamEstimator::search() {
  directions_seen_.clear();
  for (const LampSighting& seen : sightings_)
    directions_seen_.push_back({.azimuth_rad = seen.azimuth_rad,
                                .sigma_rad = std::sqrt(seen.covariance.xx),
                                .elevation_rad = kPi / 2.0 - seen.zenith_rad,
                                .sigma_elevation_rad = std::sqrt(seen.covariance.yy),
                                .identity = seen.identity});
  relocaliser_.update(directions_seen_);
  const std::optional<PoseHypothesis> found = relocaliser_.found();
  if (!found) return false;
  filter_.place(found->T_map_body, independent(kNear_m, kNear_rad));
  searching_ = false;
  ++counts_.recovered;
  last_accepted_m_ = path_m_;
  return true;
}

std::string_view FastSlamEstimator::why_lost() const {
  if (relocaliser_.is_ambiguous()) return "several places on the map look alike";
  return "none of the landmarks is where it should be";
}

/// Saves only landmarks that are proven to be lamps.
bool FastSlamEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  if (judged(belief().total_covariance(), path_m_).health == Health::lost || !filter_.save(out)) return false;
  out.names = names_of(rig_);
  return true;
}

}  // namespace azimuth
