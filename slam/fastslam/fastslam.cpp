#include "slam/fastslam/fastslam.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/fastslam/ray_fit.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

namespace {

constexpr double kMostCertainDetection = 0.95;  // A bound below 1, so that a missed lamp cannot make a weight zero
// Distance that a particle may move before all its landmarks are tested for nearness again
constexpr double kNear_m = 1.0;
constexpr double kRounding_m = 1e-6, kRounding = 1e-9;

}  // namespace

FastSlam::FastSlam(const FastSlamSettings& settings, const LampCamera& camera, const Eigen::Vector2d& sigma_scales)
    : settings_(settings),
      camera_(camera),
      cos_inner_zenith_(std::cos((1.0 - settings.view.inner_margin) * camera.max_zenith_rad)),
      log_miss_(std::log(1.0 - std::min(camera.detection_probability, kMostCertainDetection))),
      log_detection_(std::log(camera.detection_probability)),
      random_(Xoshiro(static_cast<std::uint64_t>(settings.seed))),
      particles_(as_size(settings.particles), as_size(settings.max_landmarks), as_size(settings.candidates.most)),
      errors_(as_size(settings.max_landmarks), kMostSightings, sigma_scales),
      recognition_(settings, camera, kMostSightings),
      kept_(as_size(Particles::kPathSteps) * kMostSightings),
      log_weights_(as_size(settings.particles)),
      weights_(as_size(settings.particles)),
      sources_(as_size(settings.particles)) {
  candidate_work_.lamps.reserve(as_size(settings.candidates.most));
  candidate_work_.pairs.reserve(as_size(settings.candidates.most) * kMostSightings);
  candidate_work_.target_of.reserve(kMostSightings);
  candidate_work_.free.reserve(kMostSightings);
  candidate_work_.rays.reserve(LampCandidate::kMostSightings);
  candidate_work_.gathered.reserve(LampCandidate::kMostSightings);
  log_reflections_.reserve(kMostSightings);
  lamps_of_sightings_.reserve(particles_.size() * kMostSightings);
}

void FastSlam::predict(const Motion& motion) {
  const MovedPose moved = apply(pending_.T_start_end, motion);
  pending_.covariance = moved.G * pending_.covariance * moved.G.transpose() + moved.noise;
  pending_.T_start_end = moved.T_map_body;
  pending_.path_m += motion.path_m;
  pending_.turned_rad += motion.turned_rad;
}

void FastSlam::update(std::span<const LampSighting> sightings, LampAssociator& associator, std::size_t lights) {
  begin(sightings.first(std::min(sightings.size(), kMostSightings)), std::max(lights, sightings.size()));
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    if (k + 1 < particles_.size()) particles_.fetch_ahead(k + 1, step_, recognition_.lamps());
    step(k, associator);
  }
  finish();
  follow_best();
}

void FastSlam::begin(std::span<const LampSighting> sightings, std::size_t lights) {
  seen_ = sightings;
  // Plus one for the image's lamps: all lights may be reflections, and the count must not be 0
  const Reflections reflections(lights + 1, camera_.max_zenith_rad);
  log_reflections_.clear();
  for (const LampSighting& seen : seen_) log_reflections_.push_back(reflections.log_density(seen));
  recognition_.begin(seen_);
  lamps_of_sightings_.assign(particles_.size() * seen_.size(), kNoLamp);
  since_key_m_ += pending_.path_m;
  is_key_ = step_ < 0 || since_key_m_ >= settings_.key_distance_m;
  if (!is_key_) return;
  since_key_m_ = 0.0;
  ++step_;
  std::ranges::copy(seen_,
                    kept_.begin() + (step_ % Particles::kPathSteps) * static_cast<std::ptrdiff_t>(kMostSightings));
}

const LampSighting& FastSlam::sighting(const SightingIndex& index) const {
  return kept_[as_size(index.step % Particles::kPathSteps) * kMostSightings + as_size(index.in_step)];
}

/// Algorithm 1 for one particle: the predicted pose (its mean, since only the proposal is sampled), the landmarks
/// recognised from it, the pose (algorithm 3), and landmarks, weight and candidates (algorithm 4).
void FastSlam::step(std::size_t k, LampAssociator& associator) {
  const MovedPose moved = apply(particles_[k].T_map_body, pending_);
  ParticleStep step{k, Viewpoint(moved.T_map_body, camera_.height_m), {}, Symmetric3::of(moved.noise)};
  if (k == best_) errors_.predict(moved);
  recognition_.recognise(particles_, step, associator);
  note_recognised(k);
  weigh_evidence(step);
  propose(step);
  if (is_key_) ask_which_are_near(step);  // Before learn(), which marks the landmarks that it corrects as near
  learn(step);
  if (is_key_ && !holds_map_ && k == best_) follow_pose();
  if (is_key_) miss_landmarks(step);
  if (!holds_map_) observe_candidates(step, associator);
}

void FastSlam::note_recognised(std::size_t k) {
  for (std::size_t l = 0; l < seen_.size(); ++l)
    if (const ExpectedLamp* lamp = recognition_.lamp_of(l))
      lamps_of_sightings_[k * seen_.size() + l] = particles_.infos(k)[as_size(lamp->slot)].id;
}

/// Runs before the image changes the map. For an unproven landmark only kept detections count, since a reflection seen
/// from one place is as steady as a lamp.
void FastSlam::weigh_evidence(const ParticleStep& step) {
  double& log_evidence = particles_[step.k].log_evidence;
  log_evidence = 0.0;
  const auto infos = particles_.infos(step.k);
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    const ExpectedLamp* const lamp = recognition_.lamp_of(l);
    if (lamp == nullptr) continue;
    LampEvidence& evidence = infos[as_size(lamp->slot)].evidence;
    const double log_likelihood = log_detection_ + recognition_.log_likelihood_of(l);
    if (evidence.proven()) log_evidence += log_likelihood - log_reflections_[l];
    if (is_key_) evidence.seen(log_likelihood, log_reflections_[l]);
  }
}

bool FastSlam::is_in_inner_view(const Viewpoint& from, const Eigen::Vector3d& p_map) const {
  const double dx = p_map.x() - from.x_m, dy = p_map.y() - from.y_m, dz = p_map.z() - from.z_m;
  return is_within_zenith(dx * dx + dy * dy, dz, cos_inner_zenith_);
}

PoseProposal FastSlam::linear_proposal(const ParticleStep& step) const {
  PoseProposal proposal(step.x_hat.pose(), step.R);
  for (const std::size_t l : recognition_.by_certainty()) {
    const ExpectedLamp& lamp = *recognition_.lamp_of(l);
    proposal.add(lamp.view, recognition_.innovation_of(l), lamp.of_point + seen_[l].covariance);
  }
  return proposal;
}

/// Algorithm 3, and its part of the weight. Without a recognised landmark of type I the pose is drawn from the motion
/// alone.
void FastSlam::propose(ParticleStep& step) {
  Particle& particle = particles_[step.k];
  PoseProposal proposal = linear_proposal(step);
  if (settings_.weight.method == ParticleWeight::stacked) particle.log_weight += proposal.log_likelihood();
  if (settings_.relinearise) {
    proposal = PoseProposal(step.x_hat.pose(), step.R);
    for (const std::size_t l : recognition_.by_certainty()) {
      const auto slot = as_size(recognition_.lamp_of(l)->slot);
      proposal.add_relinearised(particles_.positions(step.k)[slot], particles_.covariances(step.k)[slot], seen_[l],
                                camera_.height_m);
    }
  }
  if (step.k == best_) follow_proposal(step, proposal.covariance());
  const double first = random_.normal(), second = random_.normal(), third = random_.normal();
  const Eigen::Matrix3d L = semidefinite_factor(proposal.covariance());
  const Eigen::Vector3d noise = L.col(0) * first + (L.col(1) * second + L.col(2) * third);
  step.x_t = Viewpoint(proposal.mean() + noise, camera_.height_m);
  particle.T_map_body = step.x_t.T_map_body();
  particle.gathered = particle.gathered + proposal.covariance();
  if (is_key_) particles_.path(step.k, step_) = {step.x_t, particle.gathered};
}

/// Algorithm 4, lines 4 to 16.
void FastSlam::learn(ParticleStep& step) {
  const bool stacked = settings_.weight.method == ParticleWeight::stacked;
  double& log_weight = particles_[step.k].log_weight;
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    const LampSighting& seen = seen_[l];
    const ExpectedLamp* const lamp = recognition_.lamp_of(l);
    if (lamp == nullptr) {
      if (stacked) log_weight += seen.log_peak - settings_.weight.unexplained_penalty;
      continue;
    }
    const auto slot = as_size(lamp->slot);
    Eigen::Vector3d& p_map = particles_.positions(step.k)[slot];
    Symmetric3& Sigma = particles_.covariances(step.k)[slot];
    LampInfo& info = particles_.infos(step.k)[slot];
    if (info.near && !stacked) log_weight += log_weight_paper(step.x_t, step.R, seen, p_map, Sigma);
    if (!info.near && stacked) log_weight += seen.log_peak - settings_.weight.far_landmark_penalty;
    if (holds_map_) continue;
    if (step.k == best_) errors_.learn(l, info.id, view(step.x_t, p_map), Sigma, seen.covariance);
    correct(step.x_t, seen, p_map, Sigma);
    particles_.nearby(step.k).insert(slot);
    ++info.sightings;
    if (is_key_) info.counter = std::min(info.counter + 1, settings_.max_counter);
    info.near = info.near || view(step.x_t, p_map).rho_m < settings_.near_distance_m;
  }
}

/// Tests all landmarks for nearness, but only after the particle has moved far enough for further landmarks to come
/// near. With many landmarks, the time would otherwise be dominated by memory access.
void FastSlam::ask_which_are_near(const ParticleStep& step) {
  const Eigen::Vector2d here{step.x_t.x_m, step.x_t.y_m};
  std::optional<Eigen::Vector2d>& asked_from_m = particles_[step.k].asked_from_m;
  if (asked_from_m && (here - *asked_from_m).squaredNorm() < kNear_m * kNear_m) return;
  asked_from_m = here;
  const auto positions = particles_.positions(step.k);
  for (std::size_t slot = 0; slot < positions.size(); ++slot) {
    const double rho = std::max(0.0, (positions[slot].head<2>() - here).norm() - kNear_m - kRounding_m);
    const bool may_come = cos_inner_zenith_ <= 0.0 || is_within_zenith(rho * rho, positions[slot].z() - step.x_t.z_m,
                                                                       cos_inner_zenith_ - kRounding);
    if (may_come)
      particles_.nearby(step.k).insert(slot);
    else
      particles_.nearby(step.k).erase(slot);
  }
}

/// Algorithm 4, lines 21 and 22. Landmarks near the image's rim do not count as missed. Refuted landmarks are deleted
/// too. The state of a landmark that is not near cannot change here, since each corrected landmark is marked as near.
void FastSlam::miss_landmarks(ParticleStep& step) {
  Particle& particle = particles_[step.k];
  particles_.nearby(step.k).for_each_from_last([&](std::size_t slot) {
    const bool missed = recognition_.recognised()[slot] == 0;
    if (missed && !is_in_inner_view(step.x_t, particles_.positions(step.k)[slot])) return;
    LampInfo& info = particles_.infos(step.k)[slot];
    if (missed) {
      particle.log_weight += log_miss_;
      if (info.evidence.proven()) particle.log_evidence += log_miss_;
      if (holds_map_) return;
      info.evidence.missed(log_miss_);
      --info.counter;
    }
    const bool refuted = settings_.refute_landmarks && info.evidence.refuted();
    if (holds_map_ || (info.counter >= 0 && !refuted)) return;
    particles_.remove_landmark(step.k, slot);
    ++particle.counts.deleted;
  });
}

void FastSlam::finish() {
  pending_ = {};
  sightings_so_far_ += static_cast<std::int64_t>(seen_.size());
  for (std::size_t k = 0; k < particles_.size(); ++k) log_weights_[k] = particles_[k].log_weight;
  best_ = as_size(std::ranges::max_element(log_weights_) - log_weights_.begin());
  assert(std::isfinite(log_weights_[best_]));
  for (std::size_t k = 0; k < particles_.size(); ++k) particles_[k].log_weight -= log_weights_[best_];

  const auto count = static_cast<double>(particles_.size());
  const double effective = normalise(log_weights_, weights_);
  if (settings_.weight.resample_below_share < 1.0 && effective >= settings_.weight.resample_below_share * count) return;
  low_variance(weights_, random_.uniform() / count, sources_);
  particles_.resample(sources_, step_);
  for (std::size_t k = 0; k < particles_.size(); ++k) particles_[k].log_weight = 0.0;
}

std::size_t FastSlam::proven() const {
  return as_size(
      std::ranges::count_if(particles_.infos(best_), [](const LampInfo& info) { return info.evidence.proven(); }));
}

std::span<const std::int64_t> FastSlam::lamps_of_sightings() const {
  return std::span(lamps_of_sightings_).subspan(best_ * seen_.size(), seen_.size());
}

// Propagation of the best particle's error covariance (docs/mathematics.md II.11).

/// Propagates the errors through the step of the particle that was the best before this image. Most particles take
/// nearly the same step, and which particle becomes the best is known only after the step.
void FastSlam::follow_proposal(const ParticleStep& step, const Symmetric3& proposal) {
  errors_.begin_image(seen_.size());
  for (const std::size_t l : recognition_.by_certainty()) {
    const ExpectedLamp& lamp = *recognition_.lamp_of(l);
    const auto slot = as_size(lamp.slot);
    errors_.sight(l, particles_.infos(step.k)[slot].id, lamp.view, particles_.covariances(step.k)[slot],
                  seen_[l].covariance);
  }
  errors_.draw(proposal);
}

/// A new landmark can be mapped only from a pose that detects something unmapped, so only such poses are kept.
void FastSlam::follow_pose() {
  bool all_known = true;
  for (std::size_t l = 0; l < seen_.size(); ++l) all_known = all_known && recognition_.lamp_of(l) != nullptr;
  if (!all_known) errors_.keep_pose(step_);
}

/// Follows the new best particle: landmarks that only this particle has mapped are added as if mapped just now.
void FastSlam::follow_best() {
  const auto infos = particles_.infos(best_);
  errors_.keep_if([&](std::int64_t id) { return std::ranges::find(infos, id, &LampInfo::id) != infos.end(); });
  for (std::size_t slot = 0; slot < infos.size(); ++slot)
    if (!errors_.has(infos[slot].id))
      errors_.add(infos[slot].id, particles_[best_].T_map_body, particles_.positions(best_)[slot],
                  particles_.mapped_with(best_)[slot]);
}

/// Adds a new landmark. The errors of the poses from which it was mapped are known as far as these poses are kept.
void FastSlam::follow_new(const LampCandidate& candidate, const Eigen::Vector3d& p_map) {
  const auto sightings = std::span(candidate.sightings).first(candidate.sighting_count);
  std::size_t kept = sightings.size() - 1;
  while (kept > 0 && errors_.keeps_pose(sightings[kept - 1].step)) --kept;
  const LampFitError error = error_of_fit(candidate_work_.rays, candidate_work_.gathered, p_map, kept);
  for (; kept < sightings.size(); ++kept) errors_.mapped_from(sightings[kept].step, error.by_poses[kept]);
  errors_.add(candidate.id, error.own);
}

}  // namespace azimuth
