#include "slam/fastslam/lamp_recognition.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kFarOff_sigmas = 8.0;

}  // namespace

LampRecognition::LampRecognition(const FastSlamSettings& settings, const LampCamera& camera, std::size_t most_sightings)
    : settings_(settings.association), has_names_(camera.identities), cos_max_zenith_(std::cos(camera.max_zenith_rad)) {
  lamps_.reserve(as_size(settings.max_landmarks));
  pairs_.reserve(lamps_.capacity() * most_sightings);
  recognised_.reserve(as_size(settings.max_landmarks));
  target_of_.reserve(most_sightings);
  likelihood_of_.reserve(most_sightings);
  of_landmark_.resize(most_sightings);
  log_new_.reserve(most_sightings);
  order_.reserve(most_sightings);
  last_slots_.reserve(most_sightings);
}

void LampRecognition::begin(std::span<const LampSighting> seen) {
  seen_ = seen;
  last_slots_.assign(seen_.size(), 0);
  log_new_.clear();
  for (const LampSighting& sighting : seen_) log_new_.push_back(azimuth::log_new(sighting, settings_.gate_sigmas));
}

void LampRecognition::recognise(const Particles& particles, const ParticleStep& step, LampAssociator& associator) {
  target_of_.assign(seen_.size(), kNoTarget);
  likelihood_of_.assign(seen_.size(), 0.0);
  lamps_.clear();
  if (has_names_) {
    recognise_names(particles, step);
  } else {
    expect_visible(particles, step);
    pair_landmarks(particles, step);
    associate(associator);
  }
  weigh(step.x_hat);
  recognised_.assign(particles[step.k].landmarks, 0);
  for (std::size_t l = 0; l < seen_.size(); ++l)
    if (const ExpectedLamp* lamp = lamp_of(l)) recognised_[as_size(lamp->slot)] = 1;
  order_by_certainty(particles, step.k);
}

/// Finds the landmark with the detection's identity. Most particles have it in the slot where the previous particle had
/// it, since they have a common ancestor; a search would load the particle's whole map from memory.
std::size_t LampRecognition::slot_of_name(std::span<const LampInfo> infos, std::size_t sighting) {
  std::size_t& slot = last_slots_[sighting];
  const Identity name = seen_[sighting].identity;
  if (slot >= infos.size() || infos[slot].identity != name)
    slot = as_size(std::ranges::find(infos, name, &LampInfo::identity) - infos.begin());
  return slot;
}

void LampRecognition::recognise_names(const Particles& particles, const ParticleStep& step) {
  const auto infos = particles.infos(step.k);
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    if (seen_[l].identity == kUnknownIdentity) continue;
    const std::size_t slot = slot_of_name(infos, l);
    if (slot == infos.size()) continue;
    const bool repeated =
        std::ranges::any_of(lamps_, [slot](const ExpectedLamp& lamp) { return as_size(lamp.slot) == slot; });
    if (repeated) continue;
    target_of_[l] = static_cast<int>(lamps_.size());
    lamps_.push_back(
        expect(step.x_hat, step.R, particles.positions(step.k)[slot], particles.covariances(step.k)[slot]));
    lamps_.back().slot = static_cast<int>(slot);
  }
}

void LampRecognition::expect_visible(const Particles& particles, const ParticleStep& step) {
  const auto positions = particles.positions(step.k);
  const auto covariances = particles.covariances(step.k);
  for (std::size_t slot = 0; slot < positions.size(); ++slot) {
    if (!may_be_in_view(step, positions[slot], covariances[slot])) continue;
    lamps_.push_back(expect(step.x_hat, step.R, positions[slot], covariances[slot]));
    lamps_.back().slot = static_cast<int>(slot);
  }
}

/// Returns false if the landmark is outside the image even at the nearest position that its covariance allows.
bool LampRecognition::may_be_in_view(const ParticleStep& step, const Eigen::Vector3d& p_map,
                                     const Symmetric3& Sigma) const {
  const double dx = p_map.x() - step.x_hat.x_m, dy = p_map.y() - step.x_hat.y_m;
  const double doubt_m = kFarOff_sigmas * std::sqrt(Sigma.trace() + step.R.xx + step.R.yy);
  const double rho = std::max(0.0, std::sqrt(dx * dx + dy * dy) - doubt_m), dz = p_map.z() - step.x_hat.z_m + doubt_m;
  constexpr double kOutside = 0.05;  // Margin of the cosine for the noise of the zenith
  return is_within_zenith(rho * rho, dz, cos_max_zenith_ - kOutside);
}

/// Algorithm 2 for every pair that cannot be ruled out without computing angles. The test uses that sin^2 of an
/// innovation is at most its square, and that this square over its variance is at most the squared Mahalanobis
/// distance.
void LampRecognition::pair_landmarks(const Particles& particles, const ParticleStep& step) {
  pairs_.clear();
  const bool marginal = settings_.likelihood == LampLikelihood::marginal;
  const double gate2 = settings_.gate_sigmas * settings_.gate_sigmas;
  const auto positions = particles.positions(step.k);
  for (std::size_t l = 0; l < seen_.size(); ++l)
    for (std::size_t t = 0; t < lamps_.size(); ++t) {
      const ExpectedLamp& lamp = lamps_[t];
      const LampSighting& seen = seen_[l];
      double log_likelihood = 0.0;
      if (marginal) {
        const Offset off = offset(lamp.view, step.x_hat, seen);
        const Symmetric2 S = lamp.of_pose + lamp.of_point + seen.covariance;
        const Both off2 = off.across_m * off.across_m;
        const Both most2 = gate2 * Both{S.xx, S.yy} * Both{lamp.view.rho_m * lamp.view.rho_m, lamp.view.distance2_m2};
        if (off2[0] > most2[0] || off2[1] > most2[1]) continue;
        log_likelihood = log_normal(off.innovation(), S);
      } else {
        log_likelihood = log_likelihood_paper(lamp, step.x_hat, step.R, positions[as_size(lamp.slot)], seen);
      }
      if (log_likelihood > log_new_[l]) pairs_.push_back({static_cast<int>(l), static_cast<int>(t), log_likelihood});
    }
}

void LampRecognition::associate(LampAssociator& associator) {
  associator.associate({pairs_, log_new_, lamps_.size()}, target_of_);
  for (const LampPair& pair : pairs_)
    if (target_of_[as_size(pair.sighting)] == pair.target) likelihood_of_[as_size(pair.sighting)] = pair.log_likelihood;
}

void LampRecognition::weigh(const Viewpoint& x_hat) {
  for (std::size_t l = 0; l < seen_.size(); ++l) {
    const ExpectedLamp* const lamp = lamp_of(l);
    if (lamp == nullptr) continue;
    const Eigen::Vector2d nu = innovation(lamp->view, x_hat, seen_[l]);
    of_landmark_[l] = {nu, log_likelihood_marginal(*lamp, nu, seen_[l])};
  }
}

/// Orders the detections of near landmarks. Of equally certain landmarks, the less likely detection comes first.
void LampRecognition::order_by_certainty(const Particles& particles, std::size_t k) {
  order_.clear();
  const auto infos = particles.infos(k);
  for (std::size_t l = 0; l < seen_.size(); ++l)
    if (const ExpectedLamp* lamp = lamp_of(l); lamp != nullptr && infos[as_size(lamp->slot)].near) order_.push_back(l);
  const auto trace = [this](std::size_t l) { return lamp_of(l)->trace_m2; };
  std::ranges::sort(order_, [&](std::size_t a, std::size_t b) {
    if (trace(a) != trace(b)) return trace(a) < trace(b);
    return likelihood_of_[a] != likelihood_of_[b] ? likelihood_of_[a] < likelihood_of_[b] : a < b;
  });
}

}  // namespace azimuth
