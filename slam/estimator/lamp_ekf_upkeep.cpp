// LampEkfEstimator: what becomes of the map after an image: contradiction, misses, twins, new lamps, promotion.

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/estimator/lamp_ekf_estimator.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewestExpected = 3;   // lamps that must be due before their absence says anything of the pose
constexpr double kVagueDirection_rad = 0.1;  // where a lamp is due so vaguely nothing is missed
constexpr int kMostDoubts = 5;               // images that must agree after many that did not
constexpr double kNear = 1.0;                // in metres for each metre of height

std::size_t room_below(int most, std::size_t used) {
  const auto size = static_cast<std::size_t>(most);
  return size > used ? size - used : 0;
}

}  // namespace

bool LampEkfEstimator::is_in_view(const Predicted& predicted) const {
  const double m2 = predicted.offset.m.squaredNorm();
  const double variance_rad2 = predicted.covariance.trace() / (1.0 + m2);
  return std::atan(std::sqrt(m2)) < max_zenith_rad_ * (1.0 - settings_.inner_margin) &&
         variance_rad2 < kVagueDirection_rad * kVagueDirection_rad;
}

/// A third of the lamps that should be seen are not, although there are lights: then the pose is wrong, not the map.
/// Below lamps at regular distances some fit by chance, wherever the robot is.
bool LampEkfEstimator::contradicts_the_map() const {
  std::size_t due = 0, recognised = 0;
  for (const Predicted& predicted : predicted_)
    due += lamps_[predicted.lamp].confirmed && is_in_view(predicted) ? 1 : 0;
  for (const DirectionMatch& match : matches_)
    if (match.fate == DirectionFate::paired) recognised += lamps_[paired(match).lamp].confirmed ? 1 : 0;
  const std::size_t possible = std::min(due, lights_);
  return due >= kFewestExpected && possible >= kFewestExpected - 1 && 3 * recognised < 2 * possible;
}

/// Such an image changes nothing; after a few of them the pose is taken to be twice as uncertain.
void LampEkfEstimator::recover() {
  counts_.rejected += measured_.size();
  ++contradictions_;
  doubts_ = std::min(doubts_ + 1, kMostDoubts);
  if (settings_.recover_after_images <= 0 || contradictions_ < settings_.recover_after_images) return;
  contradictions_ = 0;
  ++deaf_streaks_;
  ++counts_.recovered;
  const Eigen::Matrix3d P = ekf_.state().pose_covariance();
  const bool is_lost = std::sqrt(std::max(P(0, 0), P(1, 1))) > settings_.health.lost_sigma_m ||
                       std::sqrt(P(2, 2)) > settings_.health.lost_sigma_heading_rad;
  if (!is_lost) ekf_.inflate_robot(P);
}

/// One image that agrees by chance must not begin a second map beside the first.
void LampEkfEstimator::agree() {
  contradictions_ = std::max(contradictions_ - 1, 0);
  doubts_ = std::max(doubts_ - 1, 0);
}

/// Only after some driving: what is hidden from here stays hidden while the robot stands. And only where a mapped lamp
/// was recognised: in the dark all of them are missed, and none is gone. Nor does a crowd tell, in which they are lost.
void LampEkfEstimator::count_misses() {
  if (crowded_ || doubts_ > 0 || sightings_.empty() || path_m_ - last_judged_m_ < settings_.judge_every_m) return;
  last_judged_m_ = path_m_;
  for (const Predicted& predicted : predicted_) {
    Lamp& lamp = lamps_[predicted.lamp];
    if (lamp.last_image == image_ || !is_in_view(predicted)) continue;
    lamp.log_odds += log_missed_;
    ++lamp.missed_in_row;
  }
}

/// Clutter, what was switched off, and what is not above the camera after all.
void LampEkfEstimator::forget_doubtful() {
  for (std::size_t i = lamps_.size(); i-- > 0;) {
    const Lamp& lamp = lamps_[i];
    const bool unseen = !lamp.confirmed && path_m_ - lamp.last_seen_m > settings_.probation_m;
    const bool none = lamp.log_odds < settings_.forget_log_odds || lamp.evidence.refuted();
    if (none || unseen || !ekf_.predict(lamp.at)) remove_lamp(i);
  }
}

/// A lamp that is missed again and again while another one is seen at the same place is that one. They are never merged
/// once they were seen in one image.
void LampEkfEstimator::merge_twins() {
  if (settings_.merge_chi2 <= 0.0) return;
  for (std::size_t i = lamps_.size(); i-- > 0;) {
    if (lamps_[i].missed_in_row < settings_.merge_after_misses) continue;
    const std::optional<std::size_t> twin = twin_of(lamps_[i]);
    if (!twin) continue;
    ekf_.merge(lamps_[*twin].at, lamps_[i].at);
    lamps_[*twin].sightings += lamps_[i].sightings;
    if (lamps_[i].evidence.proven()) lamps_[*twin].evidence = lamps_[i].evidence;
    lamps_[*twin].confirmed = lamps_[*twin].confirmed || lamps_[i].confirmed;
    forget_lamp(i);
  }
}

/// The only lamp seen now that may be the missed one; nothing when there are two.
std::optional<std::size_t> LampEkfEstimator::twin_of(const Lamp& missed) const {
  std::optional<std::size_t> twin;
  if (missed.at.kind != BlockKind::point3) return twin;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const Lamp& other = lamps_[i];
    if (other.id == missed.id || other.at.kind != BlockKind::point3 || other.last_image != image_) continue;
    if (ekf_.squared_distance(other.at, missed.at) > settings_.merge_chi2) continue;
    if (twin || are_apart(other.id, missed.id) || other.identity != missed.identity) return std::nullopt;
    twin = i;
  }
  return twin;
}

bool LampEkfEstimator::are_apart(std::int64_t a, std::int64_t b) const {
  return std::ranges::any_of(apart_,
                             [&](const Apart& pair) { return pair.a == std::min(a, b) && pair.b == std::max(a, b); });
}

/// Of lamps far from each other nobody will ever ask.
void LampEkfEstimator::note_apart() {
  for (std::size_t r = 0; r < near_.size(); ++r)
    for (std::size_t c = 0; c < r; ++c) {
      const Predicted &a = predicted_[near_[r]], &b = predicted_[near_[c]];
      const Lamp &first = lamps_[a.lamp], &second = lamps_[b.lamp];
      if (first.last_image != image_ || second.last_image != image_) continue;
      if ((a.offset.m - b.offset.m).norm() > kNear || are_apart(first.id, second.id)) continue;
      apart_.push_back({std::min(first.id, second.id), std::max(first.id, second.id)});
    }
}

/// Where there is no room for all of them, every so many-th: bearings come by azimuth, so these are from all round.
void LampEkfEstimator::add_new() {
  if (crowded_ || doubts_ > 0) return;
  const std::size_t on_probation = lamps_.size() - confirmed();
  const std::size_t room = std::min(room_below(settings_.max_landmarks, lamps_.size()),
                                    room_below(settings_.max_on_probation, on_probation));
  const auto fresh =
      static_cast<std::size_t>(std::ranges::count(matches_, DirectionFate::fresh, &DirectionMatch::fate));
  const std::size_t begun = std::min(room, fresh);
  std::size_t met = 0;
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    if (matches_[i].fate != DirectionFate::fresh) continue;
    if ((met + 1) * begun / fresh > met * begun / fresh) begin_lamp(i);
    ++met;
  }
}

void LampEkfEstimator::begin_lamp(std::size_t direction) {
  Lamp& lamp = lamps_.emplace_back();
  lamp.id = next_id_++;
  lamp.identity = measured_[direction].identity;
  lamp.at = ekf_.add_lamp(seen_[direction], inverse_height_per_m_, sigma_inverse_height_per_m_);
  if (lamp.identity != kUnknownIdentity) lamp.evidence = LampEvidence::certain();
  lamp.sightings = 1;
  lamp.first_seen_m = lamp.last_seen_m = path_m_;
  lamp.last_image = image_;
}

void LampEkfEstimator::promote_converged() {
  for (Lamp& lamp : lamps_) {
    if (lamp.at.kind != BlockKind::inverse_height) continue;
    const double nonlinearity = ekf_.nonlinearity(lamp.at);
    if (nonlinearity < settings_.promote_nonlinearity) ekf_.promote(lamp.at);
    confirm(lamp, nonlinearity);
  }
}

/// A lamp beyond doubt, and seen often enough, from places far enough apart, to be at a height.
void LampEkfEstimator::confirm(Lamp& lamp, double nonlinearity) {
  const bool often = lamp.sightings >= static_cast<std::uint64_t>(settings_.confirm_after_sightings);
  const bool apart = lamp.last_seen_m - lamp.first_seen_m >= settings_.confirm_after_m;
  if (lamp.confirmed || !lamp.evidence.proven() || !often || !apart || !(nonlinearity < settings_.confirm_nonlinearity))
    return;
  lamp.confirmed = true;
  last_accepted_m_ = path_m_;
  ++counts_.created;
}

void LampEkfEstimator::remove_lamp(std::size_t at) {
  ekf_.remove(lamps_[at].at);
  forget_lamp(at);
}

void LampEkfEstimator::forget_lamp(std::size_t at) {
  const std::int64_t id = lamps_[at].id;
  std::erase_if(apart_, [id](const Apart& pair) { return pair.a == id || pair.b == id; });
  counts_.deleted += lamps_[at].confirmed ? 1 : 0;
  lamps_[at] = lamps_.back();
  lamps_.pop_back();
}

std::size_t LampEkfEstimator::confirmed() const {
  return static_cast<std::size_t>(std::ranges::count_if(lamps_, &Lamp::confirmed));
}

bool LampEkfEstimator::any_proven() const {
  return std::ranges::any_of(lamps_, [](const Lamp& lamp) { return lamp.evidence.proven(); });
}

}  // namespace azimuth
