#include "slam/fastslam/fastslam.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/resampling.hpp"

namespace azimuth {
namespace {

constexpr double kMostCertainDetection = 0.95;  // a lamp missed must not end a particle
constexpr double kFarOff_sigmas = 8.0;

std::size_t size(int count) { return static_cast<std::size_t>(count); }

double signed_square(double value) { return value * std::abs(value); }

}  // namespace

FastSlam::FastSlam(const FastSlamSettings& settings, const LampCamera& camera)
    : settings_(settings),
      camera_(camera),
      cos_max_zenith_(std::cos(camera.max_zenith_rad)),
      cos_inner_zenith_(std::cos((1.0 - settings.inner_margin) * camera.max_zenith_rad)),
      log_miss_(std::log(1.0 - std::min(camera.detection_probability, kMostCertainDetection))),
      log_detection_(std::log(camera.detection_probability)),
      random_(Xoshiro(static_cast<std::uint64_t>(settings.seed))),
      particles_(size(settings.particles), size(settings.max_landmarks), size(settings.max_candidates)),
      kept_(size(Particles::kPathSteps) * kMostSightings),
      log_weights_(size(settings.particles)),
      weights_(size(settings.particles)),
      sources_(size(settings.particles)) {
  lamps_.reserve(size(std::max(settings.max_landmarks, settings.max_candidates)));
  pairs_.reserve(lamps_.capacity() * kMostSightings);
  recognised_.reserve(size(settings.max_landmarks));
  rays_.reserve(LampCandidate::kMostSightings);
  gathered_.reserve(LampCandidate::kMostSightings);
  for (auto* of_sightings : {&target_of_, &free_}) of_sightings->reserve(kMostSightings);
  for (auto* of_sightings : {&likelihood_of_, &log_new_}) of_sightings->reserve(kMostSightings);
  order_.reserve(kMostSightings);
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
  for (std::size_t k = 0; k < particles_.size(); ++k) step(k, associator);
  finish();
}

void FastSlam::begin(std::span<const LampSighting> sightings, std::size_t lights) {
  seen_ = sightings;
  reflections_ = Reflections(lights + 1, camera_.max_zenith_rad);  // what is seen may be all, and is never none
  log_new_.clear();
  for (const LampSighting& seen : seen_) log_new_.push_back(log_new(seen, settings_.gate_sigmas));
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
  return kept_[size(static_cast<int>(index.step % Particles::kPathSteps)) * kMostSightings + size(index.in_step)];
}

/// Algorithm 1 for one particle: where the motion leads (its mean: only the proposal is sampled), what is recognised
/// from there, the pose (algorithm 3), landmarks, weight and candidates (algorithm 4).
void FastSlam::step(std::size_t k, LampAssociator& associator) {
  const MovedPose moved = apply(particles_[k].T_map_body, pending_);
  Step step{k, Viewpoint(moved.T_map_body, camera_.height_m), {}, Symmetric3::of(moved.noise)};
  recognise(step, associator);
  weigh_evidence(step);
  propose(step);
  learn(step);
  if (is_key_) miss_landmarks(step);
  observe_candidates(step, associator);
}

void FastSlam::recognise(const Step& step, LampAssociator& associator) {
  target_of_.assign(seen_.size(), kNoTarget);
  likelihood_of_.assign(seen_.size(), 0.0);
  lamps_.clear();
  if (camera_.identities) {
    recognise_names(step);
  } else {
    expect_visible(step);
    pair_landmarks(step);
    associate(associator, lamps_.size());
  }
  recognised_.assign(particles_[step.k].landmarks, 0);
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    if (target_of_[l] == kNoTarget) continue;
    const auto slot = size(lamps_[size(target_of_[l])].slot);
    recognised_[slot] = 1;
    lamps_of_sightings_[step.k * seen_.size() + l] = particles_.infos(step.k)[slot].id;
  }
}

void FastSlam::recognise_names(const Step& step) {
  const auto infos = particles_.infos(step.k);
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    if (seen_[l].identity == kUnknownIdentity) continue;
    const auto known = std::ranges::find(infos, seen_[l].identity, &LampInfo::identity);
    if (known == infos.end()) continue;
    const auto slot = static_cast<std::size_t>(known - infos.begin());
    const bool repeated =
        std::ranges::any_of(lamps_, [slot](const ExpectedLamp& lamp) { return size(lamp.slot) == slot; });
    if (repeated) continue;
    target_of_[l] = static_cast<int>(lamps_.size());
    lamps_.push_back(
        expect(step.x_hat, step.R, particles_.positions(step.k)[slot], particles_.covariances(step.k)[slot]));
    lamps_.back().slot = static_cast<int>(slot);
  }
}

/// Before anything is learnt from the image. Of a landmark that is no lamp yet only sightings count that are kept: from
/// one place a reflection is as steady as a lamp.
void FastSlam::weigh_evidence(const Step& step) {
  double& log_evidence = particles_[step.k].log_evidence;
  log_evidence = 0.0;
  const auto infos = particles_.infos(step.k);
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    if (target_of_[l] == kNoTarget) continue;
    const ExpectedLamp& lamp = lamps_[size(target_of_[l])];
    LampEvidence& evidence = infos[size(lamp.slot)].evidence;
    const double log_likelihood = log_detection_ + log_likelihood_marginal(lamp, step.x_hat, seen_[l]);
    const double log_reflection = reflections_.log_density(seen_[l]);
    if (evidence.proven()) log_evidence += log_likelihood - log_reflection;
    if (is_key_) evidence.seen(log_likelihood, log_reflection);
  }
}

void FastSlam::expect_visible(const Step& step) {
  const auto positions = particles_.positions(step.k);
  const auto covariances = particles_.covariances(step.k);
  for (std::size_t slot = 0; slot < positions.size(); ++slot) {
    if (!may_be_in_view(step, positions[slot], covariances[slot])) continue;
    lamps_.push_back(expect(step.x_hat, step.R, positions[slot], covariances[slot]));
    lamps_.back().slot = static_cast<int>(slot);
  }
}

/// False where even the nearest point that the landmark may be at is outside of the image.
bool FastSlam::may_be_in_view(const Step& step, const Eigen::Vector3d& p_map, const Symmetric3& Sigma) const {
  const double dx = p_map.x() - step.x_hat.x_m, dy = p_map.y() - step.x_hat.y_m;
  const double doubt_m = kFarOff_sigmas * std::sqrt(Sigma.trace() + step.R.xx + step.R.yy);
  const double rho = std::max(0.0, std::sqrt(dx * dx + dy * dy) - doubt_m), dz = p_map.z() - step.x_hat.z_m + doubt_m;
  constexpr double kOutside = 0.05;  // of the cosine: what noise adds to the zenith
  return signed_square(dz) >= signed_square(cos_max_zenith_ - kOutside) * (rho * rho + dz * dz);
}

bool FastSlam::is_in_inner_view(const Viewpoint& from, const Eigen::Vector3d& p_map) const {
  const double dx = p_map.x() - from.x_m, dy = p_map.y() - from.y_m, dz = p_map.z() - from.z_m;
  return signed_square(dz) >= signed_square(cos_inner_zenith_) * (dx * dx + dy * dy + dz * dz);
}

/// Algorithm 2 for every pair that is not ruled out before any angle is computed: sin^2 of an innovation is at most its
/// square, and that over its own variance at most the squared distance.
void FastSlam::pair_landmarks(const Step& step) {
  pairs_.clear();
  const bool marginal = settings_.likelihood == LampLikelihood::marginal;
  const double gate2 = settings_.gate_sigmas * settings_.gate_sigmas;
  const auto positions = particles_.positions(step.k);
  for (std::size_t l = 0; l < seen_.size(); ++l)
    for (std::size_t t = 0; t < lamps_.size(); ++t) {
      const ExpectedLamp& lamp = lamps_[t];
      const LampSighting& seen = seen_[l];
      double log_likelihood = 0.0;
      if (marginal) {
        const Offset off = offset(lamp.view, step.x_hat, seen);
        const Symmetric2 S = lamp.of_pose + lamp.of_point + seen.covariance;
        if (off.across_azimuth_m * off.across_azimuth_m > gate2 * S.xx * lamp.view.rho_m * lamp.view.rho_m ||
            off.across_zenith_m * off.across_zenith_m > gate2 * S.yy * lamp.view.distance2_m2)
          continue;
        log_likelihood = log_normal(off.innovation(), S);
      } else {
        log_likelihood = log_likelihood_paper(lamp, step.x_hat, step.R, positions[size(lamp.slot)], seen);
      }
      if (log_likelihood > log_new_[l]) pairs_.push_back({static_cast<int>(l), static_cast<int>(t), log_likelihood});
    }
}

void FastSlam::associate(LampAssociator& associator, std::size_t targets) {
  associator.associate({pairs_, log_new_, targets}, target_of_);
  for (const LampPair& pair : pairs_)
    if (target_of_[size(pair.sighting)] == pair.target) likelihood_of_[size(pair.sighting)] = pair.log_likelihood;
}

/// Of equally certain landmarks, the less likely sighting first.
void FastSlam::order_by_certainty(std::size_t k) {
  order_.clear();
  const auto infos = particles_.infos(k);
  for (std::size_t l = 0; l < seen_.size(); ++l)
    if (target_of_[l] != kNoTarget && infos[size(lamps_[size(target_of_[l])].slot)].near) order_.push_back(l);
  const auto trace = [this](std::size_t l) { return lamps_[size(target_of_[l])].trace_m2; };
  std::ranges::sort(order_, [&](std::size_t a, std::size_t b) {
    if (trace(a) != trace(b)) return trace(a) < trace(b);
    return likelihood_of_[a] != likelihood_of_[b] ? likelihood_of_[a] < likelihood_of_[b] : a < b;
  });
}

PoseProposal FastSlam::linear_proposal(const Step& step) const {
  PoseProposal proposal(step.x_hat.pose(), step.R);
  for (const std::size_t l : order_) {
    const ExpectedLamp& lamp = lamps_[size(target_of_[l])];
    proposal.add(lamp.view, innovation(lamp.view, step.x_hat, seen_[l]), lamp.of_point + seen_[l].covariance);
  }
  return proposal;
}

/// Algorithm 3, and the part of the weight that comes with it. Without a landmark of type I the pose is drawn from the
/// motion alone.
void FastSlam::propose(Step& step) {
  Particle& particle = particles_[step.k];
  order_by_certainty(step.k);
  PoseProposal proposal = linear_proposal(step);
  if (settings_.weight == ParticleWeight::stacked) particle.log_weight += proposal.log_likelihood();
  if (settings_.relinearise) {
    proposal = PoseProposal(step.x_hat.pose(), step.R);
    for (const std::size_t l : order_) {
      const auto slot = size(lamps_[size(target_of_[l])].slot);
      proposal.add_relinearised(particles_.positions(step.k)[slot], particles_.covariances(step.k)[slot], seen_[l],
                                camera_.height_m);
    }
  }
  const double first = random_.normal(), second = random_.normal(), third = random_.normal();
  const Eigen::Vector3d noise = semidefinite_factor(proposal.covariance()) * Eigen::Vector3d(first, second, third);
  step.x_t = Viewpoint(proposal.mean() + noise, camera_.height_m);
  particle.T_map_body = step.x_t.T_map_body();
  particle.gathered = particle.gathered + proposal.covariance();
  if (is_key_) particles_.path(step.k, step_) = {step.x_t, particle.gathered};
}

/// Algorithm 4, lines 4 to 16.
void FastSlam::learn(Step& step) {
  const bool stacked = settings_.weight == ParticleWeight::stacked;
  double& log_weight = particles_[step.k].log_weight;
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    const LampSighting& seen = seen_[l];
    if (target_of_[l] == kNoTarget) {
      if (stacked) log_weight += seen.log_peak - settings_.unexplained_penalty;
      continue;
    }
    const auto slot = size(lamps_[size(target_of_[l])].slot);
    Eigen::Vector3d& p_map = particles_.positions(step.k)[slot];
    Symmetric3& Sigma = particles_.covariances(step.k)[slot];
    LampInfo& info = particles_.infos(step.k)[slot];
    if (info.near && !stacked) log_weight += log_weight_paper(step.x_t, step.R, seen, p_map, Sigma);
    if (!info.near && stacked) log_weight += seen.log_peak - settings_.far_landmark_penalty;
    correct(step.x_t, seen, p_map, Sigma);
    if (is_key_) info.counter = std::min(info.counter + 1, settings_.max_counter);
    info.near = info.near || view(step.x_t, p_map).rho_m < settings_.near_distance_m;
  }
}

/// Algorithm 4, lines 21 and 22. Near the image's rim nothing counts as missed. What has turned out to be no lamp goes
/// as well.
void FastSlam::miss_landmarks(Step& step) {
  Particle& particle = particles_[step.k];
  for (std::size_t slot = recognised_.size(); slot-- > 0;) {
    LampInfo& info = particles_.infos(step.k)[slot];
    if (recognised_[slot] == 0 && is_in_inner_view(step.x_t, particles_.positions(step.k)[slot])) {
      particle.log_weight += log_miss_;
      if (info.evidence.proven()) particle.log_evidence += log_miss_;
      info.evidence.missed(log_miss_);
      --info.counter;
    }
    const bool refuted = settings_.refute_landmarks && info.evidence.refuted();
    if (info.counter >= 0 && !refuted) continue;
    particles_.remove_landmark(step.k, slot);
    ++particle.counts.deleted;
  }
}

void FastSlam::finish() {
  pending_ = {};
  sightings_so_far_ += static_cast<std::int64_t>(seen_.size());
  for (std::size_t k = 0; k < particles_.size(); ++k) log_weights_[k] = particles_[k].log_weight;
  best_ = static_cast<std::size_t>(std::ranges::max_element(log_weights_) - log_weights_.begin());
  assert(std::isfinite(log_weights_[best_]));
  for (std::size_t k = 0; k < particles_.size(); ++k) particles_[k].log_weight -= log_weights_[best_];

  const auto count = static_cast<double>(particles_.size());
  const double effective = normalise(log_weights_, weights_);
  if (settings_.resample_below_share < 1.0 && effective >= settings_.resample_below_share * count) return;
  low_variance(weights_, random_.uniform() / count, sources_);
  particles_.resample(sources_, step_);
  for (std::size_t k = 0; k < particles_.size(); ++k) particles_[k].log_weight = 0.0;
}

std::size_t FastSlam::proven() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(particles_.infos(best_), [](const LampInfo& info) { return info.evidence.proven(); }));
}

std::span<const std::int64_t> FastSlam::lamps_of_sightings() const {
  return std::span(lamps_of_sightings_).subspan(best_ * seen_.size(), seen_.size());
}

Eigen::Matrix3d FastSlam::pose_covariance() const {
  const Pose2& centre = particles_[best_].T_map_body;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double sum = 0.0;
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    Eigen::Vector3d off = particles_[k].T_map_body.vector() - centre.vector();
    off.z() = wrap(off.z());
    const double weight = std::exp(particles_[k].log_weight - particles_[best_].log_weight);
    spread += weight * off * off.transpose();
    sum += weight;
  }
  const MovedPose moved = apply(centre, pending_);
  return moved.G * (spread / sum) * moved.G.transpose() + moved.noise;
}

}  // namespace azimuth
