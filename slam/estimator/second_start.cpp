#include "slam/estimator/second_start.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

namespace azimuth {
namespace {

// A second filter that maps more landmarks than this, relative to the first, associates bearings wrongly.
constexpr double kMoreLandmarks = 1.1;
// Each restart leaves a quarter to six tenths of the previous error.
constexpr int kMostStarts = 4;

double largest_sigma_px(const CentreOffset& centre) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(centre.covariance_px2, Eigen::EigenvaluesOnly);
  return std::sqrt(axes.eigenvalues().maxCoeff());
}

/// The change of the centre, given the tilt at the start.
double moved_px(const CameraErrors& found, const Restart& beginning) {
  const CentreOffset centre = found.centre_given(beginning.camera_errors.tail<2>());
  return (centre.mean_px - beginning.camera_errors.head<2>()).norm();
}

/// Whether the heights are so nearly equal that linearising about one or the other makes no difference.
bool agree(const std::optional<UsualHeight>& a, const std::optional<UsualHeight>& b) {
  constexpr double kSame = 0.02;
  return !a || !b || std::abs(a->mean_m - b->mean_m) < kSame * a->mean_m;
}

/// Counts must never decrease: the amount by which `later` falls short of `earlier`.
std::uint64_t shortfall(std::uint64_t earlier, std::uint64_t later) { return earlier > later ? earlier - later : 0; }

/// The counts to add to those of the second filter, which processed the first filter's bearings again. All landmarks of
/// the first filter count as deleted.
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

SecondStart::SecondStart(Begin begin, double begin_again_px)
    : begin_(std::move(begin)), begin_again_px_(begin_again_px), running_(begin_(std::nullopt)) {
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
  const auto camera = running_->camera_errors();
  if (!camera || running_->searching()) return keep_no_more();
  const bool no_more_room = samples_.size() + 2 > kMostSamples;
  if (largest_sigma_px(camera->centre_given(camera->mean.tail<2>())) < begin_again_px_ &&
      (running_->views_differ() || no_more_room))
    begin_again(*camera);
  else if (no_more_room)
    keep_no_more();
}

/// Restarts up to kMostStarts - 1 times: a first filter far from the truth may have been overconfident. The second
/// filter is then overconfident as well, but closer to the truth.
void SecondStart::begin_again(const CameraErrors& camera) {
  const std::int64_t first_id = running_->next_id();
  Restart beginning{.camera_errors = camera.mean,
                    .sigma_centre_px = kBeginWider * begin_again_px_,
                    .next_id = first_id,
                    .height = running_->usual_height()};
  std::unique_ptr<RestartableEstimator> second = replayed(beginning);
  for (int beginnings = 1; beginnings < kMostStarts; ++beginnings) {
    const std::optional<CameraErrors> found = second->camera_errors();
    const std::optional<UsualHeight> height = second->usual_height();
    if (!found || (moved_px(*found, beginning) < begin_again_px_ && agree(height, beginning.height))) break;
    beginning.camera_errors = found->mean;
    beginning.height = height;
    second = replayed(beginning);
  }
  keep_no_more();
  const auto begun = static_cast<double>(first_id - running_->ids_skipped());
  const auto begun_again = static_cast<double>(second->next_id() - first_id - second->ids_skipped());
  if (second->searching() || begun_again > kMoreLandmarks * begun) return;
  before_ = left_behind(running_->counts(), second->counts());
  running_ = std::move(second);
  began_again_ = true;
}

std::unique_ptr<RestartableEstimator> SecondStart::replayed(const Restart& beginning) const {
  std::unique_ptr<RestartableEstimator> filter = begin_(beginning);
  for (const Sample& sample : samples_) {
    if (const auto* motion = std::get_if<Motion>(&sample))
      filter->predict(*motion);
    else
      filter->update(std::get<BearingSet>(sample));
  }
  return filter;
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
