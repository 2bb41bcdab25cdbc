#include "slam/particles/fastslam_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/index.hpp"
#include "slam/lost/lost_robot.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"

namespace azimuth {
namespace {

LampCamera lamp_camera(const Rig& rig, const FastSlamSettings& settings) {
  const ImageRig& image = rig.camera.image;
  LampCamera camera;
  camera.height_m = image.viewpoint_height_m.value_or(kUnknownHeight_m);
  camera.max_zenith_rad =
      settings.view.max_zenith_rad > 0.0 ? settings.view.max_zenith_rad : image.theta_max_rad.value_or(kPi / 2.0);
  camera.detection_probability = settings.view.detection_probability > 0.0
                                     ? settings.view.detection_probability
                                     : image.detection_probability.value_or(kUsualDetection);
  camera.identities = rig.camera.identities;
  return camera;
}

}  // namespace

FastSlamEstimator::FastSlamEstimator(const Rig& rig, const FastSlamSettings& settings, const MapStart& start,
                                     const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : rig_(rig),
      directions_(rig),
      judged_by_(health),
      max_landmarks_(as_size(settings.max_landmarks)),
      gate_sigmas_(settings.association.gate_sigmas),
      sigma_floor_rad_(settings.association.sigma_floor_rad),
      filter_(settings, lamp_camera(rig, settings), sigma_scales(rig.odometry)),
      association_(settings.association.method, settings.association.cost),
      inner_margin_(settings.view.inner_margin),
      relocaliser_(relocalisation) {
  sightings_.reserve(FastSlam::kMostSightings);
  expected_.reserve(as_size(settings.max_landmarks));
  directions_seen_.reserve(FastSlam::kMostSightings);
  if (start.map != nullptr) start_from(start);
}

void FastSlamEstimator::predict(const Motion& motion) {
  filter_.predict(with_floors(motion, rig_.odometry));
  path_m_ += motion.path_m;
  if (searching_) relocaliser_.predict(with_floors(motion, rig_.odometry));
}

void FastSlamEstimator::update(const BearingSet& observations) {
  troubles_.add(observations.trouble, path_m_);
  choose(observations.bearings);
  without_elevation_ = sightings_.empty() && !observations.bearings.empty();
  lights_ = observations.bearings.size();
  if (searching_ && !search()) return;
  filter_.update(sightings_, association_, lights_);
  std::uint64_t accepted = 0;
  for (const std::int64_t lamp : filter_.lamps_of_sightings()) accepted += lamp != FastSlam::kNoLamp ? 1 : 0;
  counts_.accepted += accepted;
  counts_.created = filter_.counts().created;
  counts_.deleted = filter_.counts().deleted;
  if (filter_.speaks_for_the_map()) last_accepted_m_ = path_m_;
}

/// Selects the bearings to use. If there are more than fit (many reflections), bearings at predicted lamps come first;
/// otherwise lamps without a bearing would count as missed until all are deleted.
void FastSlamEstimator::choose(const std::vector<Bearing>& bearings) {
  sightings_.clear();
  expected_.clear();
  if (bearings.size() > FastSlam::kMostSightings) expect(expected_);
  const auto is_expected = [this](const Bearing& bearing) {
    return std::ranges::any_of(expected_, [&](const ExpectedBearing& one) { return explains(one, bearing); });
  };
  for (const Bearing& bearing : bearings)
    if (expected_.empty() || is_expected(bearing)) use(bearing);
  if (expected_.empty()) return;
  for (const Bearing& bearing : bearings)
    if (!is_expected(bearing)) use(bearing);
}

void FastSlamEstimator::use(const Bearing& bearing) {
  if (sightings_.size() == FastSlam::kMostSightings) return;
  if (!std::isfinite(bearing.elevation_rad)) return;
  const double azimuth_rad = wrap(bearing.azimuth_rad + rig_.camera.yaw_offset_rad);
  sightings_.push_back(
      make_sighting(azimuth_rad, kPi / 2.0 - bearing.elevation_rad, noise_of(bearing), bearing.identity));
}

/// Noise of a bearing, including the unknown tilt of the camera, which particles do not estimate, and a floor. The
/// floor applies across the direction; for the azimuth it is divided by the sine of the zenith angle.
Symmetric2 FastSlamEstimator::noise_of(const Bearing& bearing) const {
  constexpr double kNearZenith = 0.01;
  Symmetric2 covariance = Symmetric2::of(directions_.covariance(bearing));
  if (const double sigma_tilt_rad = rig_.camera.sigma_tilt_rad.value_or(0.0); sigma_tilt_rad > 0.0) {
    covariance.xx += azimuth_variance_by_tilt(sigma_tilt_rad, bearing.elevation_rad);
    covariance.yy += sigma_tilt_rad * sigma_tilt_rad;
  }
  const double across = std::max(std::cos(bearing.elevation_rad), kNearZenith);
  covariance.xx = std::max(covariance.xx, sigma_floor_rad_ * sigma_floor_rad_ / (across * across));
  covariance.yy = std::max(covariance.yy, sigma_floor_rad_ * sigma_floor_rad_);
  return covariance;
}

PoseBelief FastSlamEstimator::belief() const {
  const ErrorCovariance& errors = filter_.errors();
  PoseBelief then{.T_map_body = filter_.particles()[filter_.best()].T_map_body, .covariance = errors.pose()};
  then.by_considered.leftCols<2>() = errors.by_scales();
  then.variances.head<2>() = errors.scale_variances();
  return moved(then, filter_.pending());
}

void FastSlamEstimator::estimate(Estimate& out) const {
  write(belief(), path_m_, out);
  const Particles& particles = filter_.particles();
  const std::size_t best = filter_.best();
  for (std::size_t slot = 0; slot < particles[best].landmarks; ++slot) {
    LandmarkEstimate& entry = out.landmarks.emplace_back();
    const Eigen::Matrix3d covariance = filter_.errors().landmark(particles.infos(best)[slot].id);
    entry.id = particles.infos(best)[slot].id;
    entry.identity = particles.infos(best)[slot].identity;
    entry.p_map_landmark_m = particles.positions(best)[slot].head<2>();
    entry.covariance_m2 = covariance.topLeftCorner<2, 2>();
    entry.z_map_landmark_m = particles.positions(best)[slot].z();
    entry.sigma_z_m = std::sqrt(covariance(2, 2));
  }
}

void FastSlamEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  write(moved(belief(), motion), path_m_ + motion.path_m, out);
}

void FastSlamEstimator::write(const PoseBelief& belief, double path_m, Estimate& out) const {
  write_belief(belief, counts_, judged(belief.total_covariance(), path_m), out);
}

Judgement FastSlamEstimator::judged(const Eigen::Matrix3d& covariance, double path_m) const {
  Judgement judgement = judge({.pose_covariance = covariance,
                               .landmarks = filter_.particles()[filter_.best()].landmarks,
                               .max_landmarks = max_landmarks_,
                               .unrecognised_m = path_m - last_accepted_m_,
                               .troubled_images = troubles_.in_row(),
                               .trouble = troubles_.last(),
                               .camera = std::nullopt,
                               .lag = std::nullopt},
                              judged_by_);
  if (searching_) return {Health::lost, why_lost()};
  if (filter_.proven() == 0) judgement = {Health::starting, why_starting(judgement)};
  return judgement;
}

/// The reason while no landmark is proven to be a lamp.
std::string_view FastSlamEstimator::why_starting(const Judgement& judgement) const {
  if (without_elevation_) return "bearings bring no elevation";
  if (lights_ > FastSlam::kMostSightings) return "too many lights to begin a map with";
  if (judgement.health == Health::starting) return judgement.reason;
  return "no landmark is known to be a lamp and not a reflection";
}

/// Squared gate on d^2 = nu^T S^-1 nu. The association requires ln N(nu; 0, S) > ln N(0; 0, Q) - g^2 / 2, which is
/// equivalent to d^2 below this value. (The paper's likelihood uses the residual after the detection has corrected the
/// pose, which lets more pass.)
static double gate2(const Symmetric2& S, const Symmetric2& Q, double sigmas) {
  return std::max(0.0, sigmas * sigmas - std::log(S.determinant() / Q.determinant()));
}

/// Predicts the lamps of the best particle's map within the camera's range. The gates of the two angles enclose the
/// ellipse of the joint gate.
void FastSlamEstimator::expect(std::vector<ExpectedBearing>& out) const {
  out.clear();
  const Particles& particles = filter_.particles();
  const std::size_t best = filter_.best();
  const MovedPose moved = apply(particles[best].T_map_body, filter_.pending());
  const Viewpoint from(moved.T_map_body, filter_.camera().height_m);
  const Symmetric3 R = Symmetric3::of(moved.noise);
  for (std::size_t slot = 0; slot < particles[best].landmarks; ++slot) {
    const ExpectedLamp lamp =
        azimuth::expect(from, R, particles.positions(best)[slot], particles.covariances(best)[slot]);
    const Eigen::Vector2d z = direction_of(lamp.view, from.heading_rad);
    if (z.y() > filter_.camera().max_zenith_rad) continue;
    const double azimuth_rad = wrap(z.x() - rig_.camera.yaw_offset_rad), elevation_rad = kPi / 2.0 - z.y();
    const Symmetric2 Q = noise_of({.azimuth_rad = azimuth_rad, .elevation_rad = elevation_rad});
    const Symmetric2 S = lamp.of_pose + lamp.of_point + Q;
    const double gate = gate2(S, Q, gate_sigmas_);
    out.push_back({.landmark = particles.infos(best)[slot].id,
                   .azimuth_rad = azimuth_rad,
                   .gate_rad = std::sqrt(gate * S.xx),
                   .elevation_rad = elevation_rad,
                   .gate_elevation_rad = std::sqrt(gate * S.yy),
                   .sigma_rad = std::sqrt(S.xx)});
  }
}

std::unique_ptr<Estimator> make_fastslam_estimator(const Rig& rig, const FastSlamSettings& settings,
                                                   const MapStart& start, const HealthSettings& health,
                                                   const RelocalisationSettings& relocalisation) {
  return std::make_unique<FastSlamEstimator>(rig, settings, start, health, relocalisation);
}

// FastSlamEstimator: saving a map, starting from a saved map, and relocalisation in it.

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
