// The candidates of one particle, and how they become landmarks (mathematics II.8).

#include <algorithm>
#include <cmath>

#include "slam/fastslam/fastslam.hpp"
#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/ray_fit.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Sets the candidate's position from its first detection, at a guessed height: accurate across the ray, uncertain
/// along it.
void place_on_ray(const Viewpoint& from, const LampSighting& seen, double height_m, double height_sigma_m,
                  LampCandidate& candidate) {
  constexpr double kLowestCosine = 0.05;  // Lower rays meet the guessed height too far away
  const Ray ray{from, &seen};
  const Eigen::Vector3d direction = ray.direction();
  const double cosine = std::max(direction.z(), kLowestCosine);
  const double length_m = height_m / cosine;
  candidate.p_map = Eigen::Vector3d(from.x_m, from.y_m, from.z_m) + length_m * direction;
  const double azimuth_rad = from.heading_rad + seen.azimuth_rad;
  const Eigen::Vector3d by_azimuth =
      length_m * seen.sin_zenith() * Eigen::Vector3d(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
  const Eigen::Vector3d by_zenith =
      length_m * Eigen::Vector3d(seen.cos_zenith() * std::cos(azimuth_rad), seen.cos_zenith() * std::sin(azimuth_rad),
                                 -seen.sin_zenith());
  const double length_sigma_m = height_sigma_m / cosine;
  candidate.covariance = {};
  candidate.covariance.add(seen.covariance.xx, by_azimuth, by_azimuth);
  candidate.covariance.add(seen.covariance.yy, by_zenith, by_zenith);
  candidate.covariance.add(length_sigma_m * length_sigma_m, direction, direction);
}

}  // namespace

CrossingRules FastSlam::rules() const {
  return {settings_.candidates.min_parallax_rad, settings_.association.gate_sigmas, settings_.candidates.min_sightings,
          settings_.candidates.min_cross_points};
}

/// Associates the detections that belong to no landmark with candidates; each detection that stays without a candidate
/// becomes a new candidate.
void FastSlam::observe_candidates(ParticleStep& step, LampAssociator& associator) {
  candidate_work_.free.clear();
  for (std::size_t l = 0; l < seen_.size(); ++l)
    if (recognition_.lamp_of(l) == nullptr) candidate_work_.free.push_back(static_cast<int>(l));
  const std::size_t before = particles_[step.k].candidates;
  pair_candidates(step);
  candidate_work_.target_of.assign(seen_.size(), kNoTarget);
  associator.associate({candidate_work_.pairs, recognition_.log_new(), before}, candidate_work_.target_of);

  for (std::size_t c = before; c-- > 0;) {
    LampCandidate& candidate = particles_.candidates(step.k)[c];
    const auto found = std::ranges::find(candidate_work_.target_of, static_cast<int>(c));
    bool done = false;
    if (found != candidate_work_.target_of.end())
      done = observe(step, candidate, as_size(found - candidate_work_.target_of.begin()));
    else if (is_key_ && is_in_inner_view(step.x_t, candidate.p_map))
      done = !candidate.counter.missed();
    if (done) particles_.remove_candidate(step.k, c);
  }
  if (!is_key_) return;
  std::erase_if(candidate_work_.free, [this](int l) { return candidate_work_.target_of[as_size(l)] != kNoTarget; });
  begin_candidates(step);
}

/// If there is not room for all detections, the starting index rotates from step to step, so that each detection gets
/// its turn: reflections vanish, lamps are detected again.
void FastSlam::begin_candidates(const ParticleStep& step) {
  constexpr std::size_t kTurn = 13;
  const std::size_t room = particles_.room_for_candidates(step.k);
  const std::size_t first = candidate_work_.free.size() > room ? kTurn * as_size(step_) : 0;
  for (std::size_t i = 0; i < candidate_work_.free.size(); ++i)
    add_candidate(step, as_size(candidate_work_.free[(first + i) % candidate_work_.free.size()]));
}

void FastSlam::pair_candidates(const ParticleStep& step) {
  candidate_work_.pairs.clear();
  const auto candidates = particles_.candidates(step.k);
  candidate_work_.lamps.clear();
  for (const LampCandidate& candidate : candidates)
    candidate_work_.lamps.push_back(expect(step.x_t, Symmetric3{}, candidate.p_map, candidate.covariance));
  for (const int l : candidate_work_.free) {
    const LampSighting& seen = seen_[as_size(l)];
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (camera_.identities && candidates[c].identity != seen.identity) continue;
      double log_likelihood = log_normal(innovation(candidate_work_.lamps[c].view, step.x_t, seen),
                                         candidate_work_.lamps[c].of_point + seen.covariance);
      const double least = recognition_.log_new()[as_size(l)];
      if (camera_.identities) log_likelihood = std::max(log_likelihood, least + 1.0);  // Identities are certain
      if (log_likelihood > least) candidate_work_.pairs.push_back({l, static_cast<int>(c), log_likelihood});
    }
  }
}

/// Returns true if the candidate has become a landmark.
bool FastSlam::observe(ParticleStep& step, LampCandidate& candidate, std::size_t l) {
  if (is_key_) candidate.counter.seen();
  correct(step.x_t, seen_[l], candidate.p_map, candidate.covariance);
  if (!is_key_) return false;
  keep_sighting(candidate, l);
  collect_rays(step, candidate);
  candidate.points.observe(candidate_work_.rays, rules());
  return candidate.points.suffice(candidate.sighting_count, rules()) && make_landmark(step, candidate);
}

/// If there is no room left, drops every other detection but keeps the oldest, which has the widest parallax.
void FastSlam::keep_sighting(LampCandidate& candidate, std::size_t l) const {
  auto& sightings = candidate.sightings;
  std::size_t& count = candidate.sighting_count;
  std::size_t forgotten = 0;
  while (forgotten < count && sightings[forgotten].step <= step_ - Particles::kPathSteps) ++forgotten;
  std::copy(sightings.begin() + static_cast<std::ptrdiff_t>(forgotten),
            sightings.begin() + static_cast<std::ptrdiff_t>(count), sightings.begin());
  count -= forgotten;
  if (count == LampCandidate::kMostSightings) {
    count /= 2;
    for (std::size_t i = 0; i < count; ++i) sightings[i] = sightings[2 * i];
  }
  sightings[count++] = {step_, static_cast<std::int32_t>(l)};
}

/// Collects the candidate's rays, the current one last, each with the pose covariance gathered since the detection.
void FastSlam::collect_rays(const ParticleStep& step, LampCandidate& candidate) {
  candidate_work_.rays.clear();
  candidate_work_.gathered.clear();
  for (const SightingIndex& index : std::span(candidate.sightings).first(candidate.sighting_count)) {
    const PathPoint& then = particles_.path(step.k, index.step);
    candidate_work_.rays.push_back({then.from, &sighting(index)});
    candidate_work_.gathered.push_back(particles_[step.k].gathered - then.gathered);
  }
}

bool FastSlam::make_landmark(ParticleStep& step, const LampCandidate& candidate) {
  if (!particles_.has_room_for_landmark(step.k)) return false;
  const double variance_m2 = settings_.new_lamp.variance_m2;
  LampFit fit{candidate.points.best(), {variance_m2, 0.0, 0.0, variance_m2, 0.0, variance_m2}};
  if (settings_.new_lamp.covariance == NewLampCovariance::geometric) {
    const std::optional<LampFit> fitted = fit_point(candidate_work_.rays, candidate_work_.gathered, fit.p_map);
    if (!fitted || fitted->p_map.z() <= camera_.height_m) return false;
    fit = *fitted;
    const double floor_m2 = settings_.new_lamp.sigma_floor_m * settings_.new_lamp.sigma_floor_m;
    fit.covariance = fit.covariance + Symmetric3{floor_m2, 0.0, 0.0, floor_m2, 0.0, floor_m2};
  }
  const bool near = std::ranges::all_of(candidate_work_.rays, [&](const Ray& ray) {
    return view(ray.from, fit.p_map).rho_m < settings_.near_distance_m;
  });
  const LampFitError error =
      error_of_fit(candidate_work_.rays, candidate_work_.gathered, fit.p_map, candidate_work_.rays.size() - 1);
  particles_.add_landmark(step.k, fit.p_map, fit.covariance,
                          {.id = candidate.id,
                           .identity = candidate.identity,
                           .counter = std::min(candidate.counter.count, settings_.max_counter),
                           .evidence = camera_.identities ? LampEvidence::certain() : LampEvidence{},
                           .near = near},
                          error.own);
  if (step.k == best_) follow_new(candidate, fit.p_map);
  ++particles_[step.k].counts.created;
  return true;
}

void FastSlam::add_candidate(const ParticleStep& step, std::size_t l) {
  const bool nameless = camera_.identities && seen_[l].identity == kUnknownIdentity;
  if (nameless || !particles_.has_room_for_candidate(step.k)) return;
  LampCandidate& candidate = particles_.add_candidate(step.k);
  candidate.id = sightings_so_far_ + static_cast<std::int64_t>(l);
  candidate.identity = seen_[l].identity;
  candidate.sightings[0] = {step_, static_cast<std::int32_t>(l)};
  candidate.sighting_count = 1;
  place_on_ray(step.x_t, seen_[l], settings_.candidates.height_m, settings_.candidates.height_sigma_m, candidate);
}

}  // namespace azimuth
