#include "slam/localisation/relocaliser.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "slam/geometry/index.hpp"
#include "slam/localisation/motion_chain.hpp"

namespace azimuth {
namespace {

constexpr double kSame_chi2 = 16.0;  // three degrees of freedom: hypotheses with a smaller squared distance are one
// The initial position may be wrong: the search area widens with the distance driven, at an increasing rate.
constexpr double kWidening = 0.25, kWidening_per_m = 0.25;
constexpr double kSame_m = 0.1, kSame_rad = 0.05;
constexpr double kHopeless = 30.0;    // log odds behind the best: not refined any further
constexpr double kForgotten = 60.0;   // log odds behind the best: dropped
constexpr double kOldShare = 0.7;     // weight of the previous images in the mean
constexpr double kRivalRatio = 0.01;  // a place this probable, relative to the best, makes the best ambiguous
// The map's own errors favour one of two places that look alike, again in every image, by about as much as one lamp.
// Only a larger difference per image is decisive.
constexpr double kDecisivePerImage = 2.5;
constexpr double kMinVariance = 1e-8;  // keeps covariances regular

PoseGaussian kept_regular(PoseGaussian pose) {
  pose.covariance.diagonal().array() += kMinVariance;
  return pose;
}

bool are_one(const PoseGaussian& a, const PoseGaussian& b) {
  const Eigen::Vector3d d(a.T_map_body.x_m - b.T_map_body.x_m, a.T_map_body.y_m - b.T_map_body.y_m,
                          wrap(a.T_map_body.heading_rad - b.T_map_body.heading_rad));
  if (d.head<2>().norm() < kSame_m && std::abs(d.z()) < kSame_rad) return true;
  return d.dot((a.covariance + b.covariance).ldlt().solve(d)) < kSame_chi2;
}

PoseGaussian gaussian(const PoseHypothesis& hypothesis) { return {hypothesis.T_map_body, hypothesis.covariance}; }

}  // namespace

double Relocaliser::Tracked::recently(std::size_t images) const {
  const auto count = std::min(images, recent.size());
  return std::accumulate(recent.begin(), recent.begin() + static_cast<std::ptrdiff_t>(count), 0.0);
}

void Relocaliser::correct(Tracked& tracked, const Compared& compared, std::size_t directions) const {
  PoseHypothesis& hypothesis = tracked.hypothesis;
  if (tracked.recent.size() > past_.size()) tracked.recent.pop_back();
  tracked.recent.insert(tracked.recent.begin(), compared.log_odds);
  hypothesis.T_map_body = compared.pose.T_map_body;
  hypothesis.covariance = compared.pose.covariance;
  hypothesis.log_odds += compared.log_odds;
  const double share = directions == 0 ? 0.0 : compared.explained / static_cast<double>(directions);
  const double old = hypothesis.images == 0 ? 0.0 : kOldShare;
  hypothesis.explained = old * hypothesis.explained + (1.0 - old) * share;
  ++hypothesis.images;
}

Relocaliser::Relocaliser(const RelocalisationSettings& settings)
    : settings_(settings), match_(settings), search_(settings) {
  tracked_.resize(as_size(settings.max_hypotheses));
  past_.resize(as_size(std::max(1, settings.history_images)));
  for (Tracked& tracked : tracked_) tracked.recent.reserve(past_.size() + 1);
  candidate_.recent.reserve(past_.size() + 1);
  hypotheses_.reserve(tracked_.size());
}

void Relocaliser::start(std::span<const KnownLandmark> landmarks, const CameraView& view,
                        const std::optional<PositionPrior>& within) {
  map_.assign(landmarks, view);
  search_.restart();
  hypotheses_.clear();
  count_ = newest_ = remembered_ = 0;
  since_key_ = {};
  driven_m_ = 0.0;
  T_start_now_ = {};
  within_ = within;
}

SearchArea Relocaliser::area() const {
  if (!within_) return {};
  const double widened_m = driven_m_ * (kWidening + kWidening_per_m * driven_m_);
  return {within_->p_map_robot_m, within_->reach_m + widened_m, inverse(T_start_now_)};
}

/// The share of the map that is in the search area, at most 1.
double Relocaliser::share_searched() const {
  const double radius_m = area().radius_m;
  return std::min(1.0, kPi * radius_m * radius_m * 2.0 * kPi * std::exp(map_.log_prior_density));
}

void Relocaliser::predict(const Motion& motion) {
  for (std::size_t i = 0; i < count_; ++i) {
    PoseHypothesis& hypothesis = tracked_[i].hypothesis;
    const PoseGaussian after = kept_regular(moved(gaussian(hypothesis), motion));
    hypothesis.T_map_body = after.T_map_body;
    hypothesis.covariance = after.covariance;
    hypothesis.driven_m += motion.path_m;
  }
  since_key_ = chained(since_key_, motion);
  driven_m_ += motion.path_m;
  T_start_now_ = T_start_now_ * motion.T_start_end;
  publish();
}

/// Whether the image is used. An image from the same pose as the last used image shows the same, errors included.
bool Relocaliser::is_key() const {
  return remembered_ == 0 || since_key_.path_m >= settings_.key_distance_m ||
         since_key_.turned_rad >= settings_.key_turn_rad;
}

void Relocaliser::update(std::span<const SeenDirection> directions) {
  if (!is_key()) return;
  image_.assign(directions, map_, as_size(settings_.max_directions));
  if (image_.rays.empty() && remembered_ == 0) return;
  past_[newest_].to_next = since_key_;
  compare_all();
  sort();
  const double mapped_share = std::max(settings_.mapped_share, count_ > 0 ? tracked_[0].beliefs.share.value() : 0.0);
  for (const SuggestedPose& suggestion : search_.suggest(map_, image_, mapped_share, area()))
    add(suggestion.T_map_body);
  drop_worthless();
  remember();
  publish();
}

void Relocaliser::compare_all() {
  for (std::size_t i = count_; i-- > 0;) {
    PoseHypothesis& hypothesis = tracked_[i].hypothesis;
    const auto compared = match_.compare(map_, image_, gaussian(hypothesis), tracked_[i].beliefs);
    if (compared)
      correct(tracked_[i], *compared, image_.rays.size());
    else
      std::swap(tracked_[i], tracked_[--count_]);
  }
}

/// Compares a suggested pose with the present image and, backwards in time, with the past images that are kept. For
/// images farther back the pose is credited with the odds of the best hypothesis, so that an old hypothesis does not
/// beat a copy of itself merely by being older. This credit does not lift the pose above the best hypothesis.
void Relocaliser::add(const Pose2& suggested) {
  candidate_.beliefs.share = MappedShare(settings_.mapped_share);
  candidate_.beliefs.lit.assign(map_.landmarks.size(), static_cast<float>(1.0 - settings_.changed_probability));
  const auto compared = match_.compare_suggested(map_, image_, suggested, candidate_.beliefs);
  if (!compared || is_known(compared->pose)) return;
  candidate_.hypothesis = {};
  candidate_.recent.clear();
  candidate_.log_prior = compared->log_prior;
  correct(candidate_, *compared, image_.rays.size());
  const Tracked* const leader = count_ > 0 ? &tracked_[0] : nullptr;
  if (!explain_past(compared->pose, leader)) return;
  double& log_odds = candidate_.hypothesis.log_odds;
  log_odds = candidate_.log_prior + candidate_.recently();
  if (leader != nullptr) {
    const double before = leader->hypothesis.log_odds - leader->log_prior - leader->recently();
    log_odds = std::max(log_odds, std::min(log_odds + before, leader->hypothesis.log_odds));
  }
  if (count_ == tracked_.size() && tracked_[count_ - 1].hypothesis.log_odds >= log_odds) return;
  if (count_ < tracked_.size()) ++count_;
  std::swap(tracked_[count_ - 1], candidate_);
  sort();
}

/// Returns false if the candidate explains past images so much worse than the leader that it is not worth keeping.
bool Relocaliser::explain_past(PoseGaussian pose, const Tracked* leader) {
  for (std::size_t ago = 0; ago < remembered_; ++ago) {
    if (leader != nullptr && candidate_.recently() < leader->recently(ago + 1) - kHopeless) return false;
    const Past& past = past_[past_index(ago)];
    const auto compared =
        match_.compare(map_, past.image, kept_regular(moved(pose, reversed(past.to_next))), candidate_.beliefs);
    if (!compared) return false;
    candidate_.recent.push_back(compared->log_odds);
    pose = compared->pose;
  }
  return true;
}

bool Relocaliser::is_known(const PoseGaussian& pose) const {
  return std::any_of(tracked_.begin(), tracked_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const Tracked& tracked) { return are_one(gaussian(tracked.hypothesis), pose); });
}

void Relocaliser::sort() {
  std::sort(tracked_.begin(), tracked_.begin() + static_cast<std::ptrdiff_t>(count_),
            [](const Tracked& a, const Tracked& b) { return a.hypothesis.log_odds > b.hypothesis.log_odds; });
}

/// Drops copies of better hypotheses, and hopeless ones.
void Relocaliser::drop_worthless() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const PoseHypothesis& hypothesis = tracked_[i].hypothesis;
    const bool is_copy =
        std::any_of(tracked_.begin(), tracked_.begin() + static_cast<std::ptrdiff_t>(kept),
                    [&](const Tracked& better) { return are_one(gaussian(better.hypothesis), gaussian(hypothesis)); });
    if (is_copy || hypothesis.log_odds < tracked_[0].hypothesis.log_odds - kForgotten) continue;
    if (kept != i) std::swap(tracked_[kept], tracked_[i]);
    ++kept;
  }
  count_ = kept;
}

void Relocaliser::remember() {
  newest_ = (newest_ + 1) % past_.size();
  std::swap(past_[newest_].image, image_);
  remembered_ = std::min(remembered_ + 1, past_.size());
  since_key_ = {};
}

/// Normalises the probabilities. The hypothesis that the robot is nowhere in the map has odds of one. The probability
/// of a place that was never suggested and is as good as the best decreases with the number of samples taken, and with
/// the size of the search area.
void Relocaliser::publish() {
  hypotheses_.clear();
  if (count_ == 0) return;
  const double best = std::max(0.0, tracked_[0].hypothesis.log_odds);
  double sum = std::exp(-best) + share_searched() * std::exp(-search_.right_samples());
  for (std::size_t i = 0; i < count_; ++i) {
    PoseHypothesis& hypothesis = hypotheses_.emplace_back(tracked_[i].hypothesis);
    hypothesis.probability = std::exp(hypothesis.log_odds - best);
    sum += hypothesis.probability;
  }
  for (PoseHypothesis& hypothesis : hypotheses_) hypothesis.probability /= sum;
}

bool Relocaliser::is_ambiguous() const {
  if (hypotheses_.size() < 2 || hypotheses_[0].log_odds <= 0.0) return false;
  const PoseHypothesis &first = hypotheses_[0], &second = hypotheses_[1];
  return second.probability > kRivalRatio * first.probability ||
         first.log_odds - second.log_odds <= kDecisivePerImage * std::min(first.images, second.images);
}

std::optional<PoseHypothesis> Relocaliser::found() const {
  if (hypotheses_.empty()) return std::nullopt;
  const PoseHypothesis& first = hypotheses_.front();
  const auto rules_out = [&](const PoseHypothesis& other) {
    return first.log_odds - other.log_odds > kDecisivePerImage * std::min(first.images, other.images);
  };
  if (!std::all_of(hypotheses_.begin() + 1, hypotheses_.end(), rules_out)) return std::nullopt;
  const bool proven = first.probability > settings_.found_probability && first.images >= settings_.found_images &&
                      first.driven_m >= settings_.found_distance_m && first.explained >= settings_.found_explained;
  return proven ? std::optional(first) : std::nullopt;
}

}  // namespace azimuth
