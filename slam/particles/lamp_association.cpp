#include "slam/particles/lamp_association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/association/fit_storage.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Index of `member` in `members`; appends it if it is not there yet.
int place_of(int member, std::vector<int>& place, std::vector<int>& members) {
  if (place[as_size(member)] == kUnassigned) {
    place[as_size(member)] = static_cast<int>(members.size());
    members.push_back(member);
  }
  return place[as_size(member)];
}

}  // namespace

void LampAssociation::associate(const LampPairs& pairs, std::span<int> target_of) {
  std::ranges::fill(target_of, kNoTarget);
  if (method_ == LampAssociationMethod::nearest) return take_nearest(pairs, target_of);
  take_undisputed(pairs, target_of);
  if (!disputed_.empty()) assign(pairs, target_of);
}

void LampAssociation::take_undisputed(const LampPairs& pairs, std::span<int> target_of) {
  fit(pairs_of_sighting_, target_of.size(), 0);
  fit(pairs_of_target_, pairs.targets, 0);
  for (const LampPair& pair : pairs.pairs) {
    ++pairs_of_sighting_[as_size(pair.sighting)];
    ++pairs_of_target_[as_size(pair.target)];
  }
  disputed_.clear();
  if (disputed_.capacity() < pairs.pairs.size()) disputed_.reserve(2 * pairs.pairs.size());
  for (const LampPair& pair : pairs.pairs) {
    if (pairs_of_sighting_[as_size(pair.sighting)] == 1 && pairs_of_target_[as_size(pair.target)] == 1)
      target_of[as_size(pair.sighting)] = pair.target;
    else
      disputed_.push_back(pair);
  }
}

double LampAssociation::worth(double log_likelihood) const {
  return cost_ == LampCost::logarithm ? log_likelihood : std::exp(log_likelihood);
}

void LampAssociation::assign(const LampPairs& pairs, std::span<int> target_of) {
  fit(row_of_sighting_, target_of.size(), kUnassigned);
  fit(column_of_target_, pairs.targets, kUnassigned);
  fit(sightings_, target_of.size(), 0);
  fit(targets_, pairs.targets, 0);
  sightings_.clear();
  targets_.clear();
  for (const LampPair& pair : disputed_) {
    place_of(pair.sighting, row_of_sighting_, sightings_);
    place_of(pair.target, column_of_target_, targets_);
  }
  fit(table_, sightings_.size() * targets_.size(), -std::numeric_limits<double>::infinity());
  for (const LampPair& pair : disputed_)
    table_[as_size(row_of_sighting_[as_size(pair.sighting)]) * targets_.size() +
           as_size(column_of_target_[as_size(pair.target)])] = worth(pair.log_likelihood);
  fit(alone_, sightings_.size(), 0.0);
  for (std::size_t r = 0; r < sightings_.size(); ++r) alone_[r] = worth(pairs.log_new[as_size(sightings_[r])]);
  fit(column_of_row_, sightings_.size(), kUnassigned);
  assignment_.solve({table_, sightings_.size(), targets_.size()}, alone_, Objective::maximise, column_of_row_);
  for (std::size_t r = 0; r < sightings_.size(); ++r)
    if (column_of_row_[r] != kUnassigned) target_of[as_size(sightings_[r])] = targets_[as_size(column_of_row_[r])];
}

/// Associates each detection in turn with its most likely free lamp.
void LampAssociation::take_nearest(const LampPairs& pairs, std::span<int> target_of) {
  fit(pairs_of_target_, pairs.targets, 0);  // 1: taken
  const LampPair* best = nullptr;
  for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
    const LampPair& pair = pairs.pairs[i];
    const bool taken = pairs_of_target_[as_size(pair.target)] != 0;
    if (!taken && (best == nullptr || pair.log_likelihood > best->log_likelihood)) best = &pair;
    const bool last = i + 1 == pairs.pairs.size() || pairs.pairs[i + 1].sighting != pair.sighting;
    if (!last || best == nullptr) continue;
    target_of[as_size(best->sighting)] = best->target;
    pairs_of_target_[as_size(best->target)] = 1;
    best = nullptr;
  }
}

}  // namespace azimuth
