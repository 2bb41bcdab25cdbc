#include "slam/fastslam/particles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "slam/geometry/index.hpp"

namespace azimuth {

Particles::Particles(std::size_t count, std::size_t max_landmarks, std::size_t max_candidates)
    : max_landmarks_(max_landmarks),
      max_candidates_(max_candidates),
      words_of_map_(SlotSet<std::uint64_t>::words_for(max_landmarks)),
      particles_(count),
      positions_(count * max_landmarks),
      covariances_(count * max_landmarks),
      infos_(count * max_landmarks),
      mapped_with_(count * max_landmarks),
      nearby_(count * words_of_map_),
      candidates_(count * max_candidates),
      path_(count * as_size(kPathSteps)),
      copies_(count) {}

void Particles::add_landmark(std::size_t k, const Eigen::Vector3d& p_map, const Symmetric3& covariance,
                             const LampInfo& info, const Symmetric3& mapped_with) {
  assert(has_room_for_landmark(k));
  const std::size_t slot = particles_[k].landmarks++, at = k * max_landmarks_ + slot;
  positions_[at] = p_map;
  covariances_[at] = covariance;
  infos_[at] = info;
  mapped_with_[at] = mapped_with;
  nearby(k).insert(slot);
}

void Particles::remove_landmark(std::size_t k, std::size_t slot) {
  positions(k)[slot] = positions(k).back();
  covariances(k)[slot] = covariances(k).back();
  infos(k)[slot] = infos(k).back();
  map_of(mapped_with_, k)[slot] = map_of(mapped_with_, k).back();
  const std::size_t last = --particles_[k].landmarks;
  SlotSet<std::uint64_t> near = nearby(k);
  if (near.contains(last))
    near.insert(slot);
  else
    near.erase(slot);
  near.erase(last);
}

LampCandidate& Particles::add_candidate(std::size_t k) {
  assert(has_room_for_candidate(k));
  ++particles_[k].candidates;
  return *std::construct_at(&candidates(k).back());  // Constructed in place, since a candidate is large
}

void Particles::remove_candidate(std::size_t k, std::size_t slot) {
  candidates(k)[slot] = candidates(k).back();
  --particles_[k].candidates;
}

void Particles::resample(std::span<const std::size_t> source, std::int64_t step) {
  std::ranges::fill(copies_, 0);
  for (const std::size_t from : source) ++copies_[from];
  std::size_t lost = 0;
  for (std::size_t from = 0; from < size(); ++from)
    for (; copies_[from] > 1; --copies_[from]) {
      while (copies_[lost] != 0) ++lost;
      copy(from, lost, step);
      copies_[lost] = 1;
    }
}

void Particles::fetch_ahead(std::size_t k, std::int64_t step, std::span<const ExpectedLamp> lamps) const {
  constexpr std::size_t kLineBytes = 64;
  const auto fetch = [](const auto* what) {
    const char* const first = reinterpret_cast<const char*>(what);
    for (std::size_t i = 0; i < sizeof(*what); i += kLineBytes) __builtin_prefetch(first + i);
    __builtin_prefetch(first + sizeof(*what) - 1);
  };
  for (const ExpectedLamp& lamp : lamps)  // There may be no landmark in this slot
    fetch(&covariances_[k * max_landmarks_ + as_size(lamp.slot)]);
  nearby(k).for_each_from_last([&](std::size_t slot) {
    fetch(&positions_[k * max_landmarks_ + slot]);
    fetch(&infos_[k * max_landmarks_ + slot]);
  });
  if (step >= 0) fetch(&path(k, step));
  asm volatile("");  // Without this, GCC takes the function as free of effects and drops the call
}

void Particles::copy(std::size_t from, std::size_t to, std::int64_t step) {
  particles_[to] = particles_[from];
  std::ranges::copy(positions(from), positions(to).begin());
  std::ranges::copy(covariances(from), covariances(to).begin());
  std::ranges::copy(infos(from), infos(to).begin());
  std::ranges::copy(map_of(mapped_with_, from), map_of(mapped_with_, to).begin());
  std::copy_n(nearby_.begin() + as_index(from * words_of_map_), words_of_map_,
              nearby_.begin() + as_index(to * words_of_map_));
  std::ranges::copy(candidates(from), candidates(to).begin());
  std::int64_t oldest = step;  // The path is needed only back to the first detection of a candidate
  for (const LampCandidate& candidate : candidates(from)) oldest = std::min(oldest, candidate.sightings[0].step);
  for (std::int64_t s = std::max(oldest, step - kPathSteps + 1); s <= step; ++s) path(to, s) = path(from, s);
}

double normalise(std::span<const double> log_weights, std::span<double> weights) {
  const double largest = *std::ranges::max_element(log_weights);
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] = std::exp(log_weights[k] - largest);
  for (double& weight : weights) {
    weight /= sum;
    squares += weight * weight;
  }
  return 1.0 / squares;
}

void low_variance(std::span<const double> weights, double start, std::span<std::size_t> source) {
  double cumulative = weights[0];
  std::size_t particle = 0;
  for (std::size_t m = 0; m < source.size(); ++m) {
    const double at = start + static_cast<double>(m) / static_cast<double>(source.size());
    while (at > cumulative && particle + 1 < weights.size()) cumulative += weights[++particle];
    source[m] = particle;
  }
}

}  // namespace azimuth
