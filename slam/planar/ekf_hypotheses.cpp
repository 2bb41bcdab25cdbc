#include "slam/planar/ekf_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kImplausible = 7.0;  // log likelihood ratio: a thousand times less likely than the best

/// Published counts must never decrease, whichever hypothesis is the best.
void raise(std::uint64_t own, std::uint64_t counted, std::uint64_t& ahead) {
  ahead = std::max(ahead, counted - std::min(counted, own));
}

}  // namespace

EkfHypotheses::EkfHypotheses(std::unique_ptr<EkfEstimator> first, int most) : most_(as_size(most)) {
  branches_.push_back({std::move(first)});
}

void EkfHypotheses::predict(const Motion& motion) {
  for (Branch& branch : branches_) branch.filter->predict(motion);
  path_m_ += motion.path_m;
  moved_ = moved_ || motion.moved();
}

void EkfHypotheses::update(const BearingSet& bearings) {
  const bool decided = path_m_ > kUndecided_m || searching();
  if (decided && branches_.size() > 1) branches_.resize(1);
  if (decided || !moved_) {
    for (Branch& branch : branches_) branch.filter->update(bearings);
  } else {
    choose(bearings);
    follow(bearings);
  }
  moved_ = false;
  count_on();
}

void EkfHypotheses::choose(const BearingSet& bearings) {
  choices_.clear();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const JointCompatibility& found = branches_[b].filter->weigh(bearings, kImplausible);
    for (std::size_t h = 0; h < found.kept(); ++h)
      choices_.push_back({b, h, branches_[b].log_likelihood + found.log_likelihood(h)});
  }
  std::ranges::stable_sort(choices_, std::greater<>{}, &Choice::log_likelihood);
  const double best = choices_.front().log_likelihood;
  std::erase_if(choices_, [&](const Choice& choice) { return choice.log_likelihood < best - kImplausible; });
  if (choices_.size() > most_) choices_.resize(most_);
}

/// Landmarks that two filters initialise in this image are distinct, so they get distinct ids.
void EkfHypotheses::follow(const BearingSet& bearings) {
  std::int64_t id = 0;
  for (const Branch& branch : branches_) id = std::max(id, branch.filter->next_id());
  next_.clear();
  for (const Choice& choice : choices_) {
    const Branch& from = branches_[choice.branch];
    Branch& to = next_.emplace_back(Branch{.filter = std::make_unique<EkfEstimator>(*from.filter),
                                           .log_likelihood = choice.log_likelihood - choices_.front().log_likelihood,
                                           .ids_skipped = from.ids_skipped});
    to.ids_skipped += id - to.filter->next_id();
    to.filter->continue_from(id);
    to.filter->update_as(bearings, choice.hypothesis);
    id = to.filter->next_id();
  }
  std::swap(branches_, next_);
  next_.clear();
}

void EkfHypotheses::count_on() {
  const AssociationCounts own = best().counts();
  raise(own.accepted, counted_.accepted, ahead_.accepted);
  raise(own.rejected, counted_.rejected, ahead_.rejected);
  raise(own.ambiguous, counted_.ambiguous, ahead_.ambiguous);
  raise(own.thinned, counted_.thinned, ahead_.thinned);
  raise(own.recovered, counted_.recovered, ahead_.recovered);
  raise(own.created, counted_.created, ahead_.created);
  raise(own.deleted, counted_.deleted, ahead_.deleted);
  // The number of mapped landmarks is `created` minus `deleted`.
  ahead_.created = ahead_.deleted = std::max(ahead_.created, ahead_.deleted);
  counted_ = counts();
}

AssociationCounts EkfHypotheses::counts() const {
  const AssociationCounts own = best().counts();
  return {.accepted = own.accepted + ahead_.accepted,
          .rejected = own.rejected + ahead_.rejected,
          .ambiguous = own.ambiguous + ahead_.ambiguous,
          .thinned = own.thinned + ahead_.thinned,
          .created = own.created + ahead_.created,
          .deleted = own.deleted + ahead_.deleted,
          .recovered = own.recovered + ahead_.recovered};
}

/// The second moment of the mixture about the most likely pose.
template <typename Write>
void EkfHypotheses::widen(Estimate& out, const Write& write) const {
  out.association = counts();
  if (branches_.size() < 2) return;
  double weights = 0.0;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Estimate other;
  for (const Branch& branch : branches_) {
    write(*branch.filter, other);
    Eigen::Vector3d apart = other.T_map_body.vector() - out.T_map_body.vector();
    apart.z() = wrap(apart.z());
    const double weight = std::exp(branch.log_likelihood);
    sum += weight * (other.pose_covariance + apart * apart.transpose());
    weights += weight;
    other.landmarks.clear();
    other.accepted.clear();
  }
  out.pose_covariance = sum / weights;
}

void EkfHypotheses::estimate(Estimate& out) const {
  best().estimate(out);
  widen(out, [](const EkfEstimator& filter, Estimate& other) { filter.estimate(other); });
}

void EkfHypotheses::look_ahead(const Motion& motion, Estimate& out) const {
  best().look_ahead(motion, out);
  widen(out, [&](const EkfEstimator& filter, Estimate& other) { filter.look_ahead(motion, other); });
}

}  // namespace azimuth
