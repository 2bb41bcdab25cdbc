#include "slam/fastslam/particles.hpp"

#include <algorithm>
#include <cassert>
#include <memory>

#include "slam/geometry/index.hpp"

namespace azimuth {

Particles::Particles(std::size_t count, std::size_t max_landmarks, std::size_t max_candidates)
    : max_landmarks_(max_landmarks),
      max_candidates_(max_candidates),
      particles_(count),
      positions_(count * max_landmarks),
      covariances_(count * max_landmarks),
      infos_(count * max_landmarks),
      mapped_with_(count * max_landmarks),
      candidates_(count * max_candidates),
      path_(count * as_size(kPathSteps)),
      copies_(count) {}

void Particles::add_landmark(std::size_t k, const Eigen::Vector3d& p_map, const Symmetric3& covariance,
                             const LampInfo& info, const Symmetric3& mapped_with) {
  assert(has_room_for_landmark(k));
  const std::size_t at = k * max_landmarks_ + particles_[k].landmarks++;
  positions_[at] = p_map;
  covariances_[at] = covariance;
  infos_[at] = info;
  mapped_with_[at] = mapped_with;
}

void Particles::remove_landmark(std::size_t k, std::size_t slot) {
  positions(k)[slot] = positions(k).back();
  covariances(k)[slot] = covariances(k).back();
  infos(k)[slot] = infos(k).back();
  map_of(mapped_with_, k)[slot] = map_of(mapped_with_, k).back();
  --particles_[k].landmarks;
}

LampCandidate& Particles::add_candidate(std::size_t k) {
  assert(has_room_for_candidate(k));
  ++particles_[k].candidates;
  return *std::construct_at(&candidates(k).back());  // no temporary: a candidate is large
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
  const auto fetch = [](const auto* first, std::size_t count = 1) {
    const std::size_t bytes = count * sizeof(*first);
    for (std::size_t i = 0; i < bytes; i += kLineBytes) __builtin_prefetch(reinterpret_cast<const char*>(first) + i);
    __builtin_prefetch(reinterpret_cast<const char*>(first) + bytes - 1);
  };
  for (const ExpectedLamp& lamp : lamps) {
    const std::size_t at = k * max_landmarks_ + as_size(lamp.slot);  // there need be no landmark
    fetch(&covariances_[at]);
    fetch(&infos_[at]);
  }
  fetch(positions(k).data(), positions(k).size());
  if (step >= 0) fetch(&path(k, step));
  asm volatile("");  // what does no more than that is taken for a function without effect, and not called
}

void Particles::copy(std::size_t from, std::size_t to, std::int64_t step) {
  particles_[to] = particles_[from];
  std::ranges::copy(positions(from), positions(to).begin());
  std::ranges::copy(covariances(from), covariances(to).begin());
  std::ranges::copy(infos(from), infos(to).begin());
  std::ranges::copy(map_of(mapped_with_, from), map_of(mapped_with_, to).begin());
  std::ranges::copy(candidates(from), candidates(to).begin());
  std::int64_t oldest = step;  // the path is only needed as far back as a candidate was first seen
  for (const LampCandidate& candidate : candidates(from)) oldest = std::min(oldest, candidate.sightings[0].step);
  for (std::int64_t s = std::max(oldest, step - kPathSteps + 1); s <= step; ++s) path(to, s) = path(from, s);
}

}  // namespace azimuth
