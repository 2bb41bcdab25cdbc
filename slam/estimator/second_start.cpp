#include "slam/estimator/second_start.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

namespace azimuth {
namespace {

// A second filter that maps this many landmarks more for each of the first's takes bearings for those of others.
constexpr double kMoreLandmarks = 1.1;

double largest_sigma_px(const CentreOffset& centre) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(centre.covariance_px2, Eigen::EigenvaluesOnly);
  return std::sqrt(axes.eigenvalues().maxCoeff());
}

/// Counts never go back: by how much `later` is short of `earlier`.
std::uint64_t shortfall(std::uint64_t earlier, std::uint64_t later) { return earlier > later ? earlier - later : 0; }

/// Of the second filter, which saw again what the first one had seen. The landmarks of the first are all gone.
AssociationCounts left_behind(const AssociationCounts& first, const AssociationCounts& second) {
  return {.accepted = shortfall(first.accepted, second.accepted),
          .rejected = shortfall(first.rejected, second.rejected),
          .ambiguous = shortfall(first.ambiguous, second.ambiguous),
          .thinned = shortfall(first.thinned, second.thinned),
          .created = first.created,
          .deleted = first.created,
          .recovered = shortfall(first.recovered, second.recovered)};
}

void add(const AssociationCounts& more, AssociationCounts& to) {
  to.accepted += more.accepted;
  to.rejected += more.rejected;
  to.ambiguous += more.ambiguous;
  to.thinned += more.thinned;
  to.created += more.created;
  to.deleted += more.deleted;
  to.recovered += more.recovered;
}

}  // namespace

bool SecondStart::is_of_use(const Rig& rig, const EkfSettings& settings) {
  return rig.front_end == FrontEnd::colour && settings.second_start_centre_px > 0.0 &&
         settings.sigma_camera_centre_px > kBeginWider * settings.second_start_centre_px;
}

SecondStart::SecondStart(const Rig& rig, const EkfSettings& settings)
    : rig_(rig), settings_(settings), running_(std::make_unique<EkfEstimator>(rig, settings)) {
  samples_.reserve(kMostSamples);
}

void SecondStart::predict(const Motion& motion) {
  running_->predict(motion);
  if (!keeps_ || !motion.moved()) return;
  samples_.emplace_back(motion);
  moved_ = true;
}

void SecondStart::update(const BearingSet& bearings) {
  running_->update(bearings);
  if (!keeps_ || !moved_) return;
  samples_.emplace_back(bearings);
  moved_ = false;
  const auto centre = running_->filter().centre_offset();
  if (!centre || running_->searching() || samples_.size() + 2 > kMostSamples) return keep_no_more();
  if (largest_sigma_px(*centre) < settings_.second_start_centre_px) begin_again(*centre);
}

void SecondStart::begin_again(const CentreOffset& centre) {
  auto second =
      std::make_unique<EkfEstimator>(rig_, settings_,
                                     SecondBeginning{.centre_px = centre.mean_px,
                                                     .sigma_centre_px = kBeginWider * settings_.second_start_centre_px,
                                                     .next_id = running_->next_id()});
  for (const Sample& sample : samples_) {
    if (const auto* motion = std::get_if<Motion>(&sample))
      second->predict(*motion);
    else
      second->update(std::get<BearingSet>(sample));
  }
  keep_no_more();
  const auto created = [](const EkfEstimator& filter) { return static_cast<double>(filter.counts().created); };
  if (second->searching() || created(*second) > kMoreLandmarks * created(*running_)) return;
  before_ = left_behind(running_->counts(), second->counts());
  running_ = std::move(second);
  began_again_ = true;
}

void SecondStart::keep_no_more() {
  keeps_ = false;
  samples_ = {};
}

void SecondStart::estimate(Estimate& out) const {
  running_->estimate(out);
  add(before_, out.association);
}

void SecondStart::look_ahead(const Motion& motion, Estimate& out) const {
  running_->look_ahead(motion, out);
  add(before_, out.association);
}

}  // namespace azimuth
