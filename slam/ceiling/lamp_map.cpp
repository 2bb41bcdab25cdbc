#include "slam/ceiling/lamp_map.hpp"

#include <algorithm>
#include <cmath>

#include "slam/ceiling/lamp_matcher.hpp"

namespace azimuth {
namespace {

constexpr double kNear = 1.0;  // In metres per metre of height
// Relative uncertainty of a new lamp's height if other lamps' heights are known; it is greater if these differ.
constexpr double kUsual = 0.15, kWiderThanSpread = 1.5;

std::size_t room_below(int most, std::size_t used) {
  const auto size = static_cast<std::size_t>(most);
  return size > used ? size - used : 0;
}

}  // namespace

/// Heights from h - s to h + s correspond to inverse heights of mean h / (h^2 - s^2) and half-width s / (h^2 - s^2).
LampMap::LampMap(const LampEkfSettings& settings, const CeilingView& view, const std::optional<UsualHeight>& usual)
    : settings_(settings),
      view_(view),
      log_seen_(std::log(view.detection_probability() / settings.gates.new_density_per_sr)) {
  const double h = settings.height.guess_m, s = std::min(settings.height.sigma_m, 0.95 * h);
  inverse_height_per_m_ = h / (h * h - s * s);
  sigma_inverse_height_per_m_ = s / (h * h - s * s);
  if (usual) {
    const double sigma_m = std::max(kUsual * usual->mean_m, kWiderThanSpread * usual->spread_m);
    inverse_height_per_m_ = 1.0 / usual->mean_m;
    sigma_inverse_height_per_m_ = std::min(sigma_inverse_height_per_m_, sigma_m / (usual->mean_m * usual->mean_m));
  }
  apart_.reserve(kTypicalLandmarks);
}

void LampMap::restore(const MapSnapshot& map, std::span<const Index> blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const MapLandmark& saved = map.landmarks[i];
    const double log_odds = log_seen_ * static_cast<double>(saved.sightings);
    book_.restore({.id = saved.id,
                   .identity = saved.identity,
                   .at = {blocks[i], BlockKind::point3},
                   .sightings = saved.sightings,
                   .log_odds = std::clamp(log_odds, 0.0, settings_.evidence.most_log_odds),
                   .evidence = LampEvidence::certain(),
                   .confirmed = true});
  }
  book_.continue_from(map.next_id);
}

/// docs/mathematics.md, VI.14. Counts only after some driving, since a reflection seen from one place is as steady as a
/// lamp.
void LampMap::weigh_evidence(LampEkf& ekf, const CeilingImage& image, const LampMatches& matches) {
  if (image.lights == 0 || path_m_ - last_weighed_m_ < settings_.evidence.judge_every_m) return;
  last_weighed_m_ = path_m_;
  const double log_reflection = Reflections(image.lights + 1, view_.max_zenith_rad()).log_per_sr();
  for (std::size_t i = 0; i < matches.of.size(); ++i) {
    const PredictedDirection* const predicted = matches.paired(i);
    if (predicted == nullptr) continue;
    Lamp& lamp = book_[predicted->lamp];
    lamp.last_weighed = image_;
    if (lamp.evidence.proven()) continue;
    // The direction in the gate may be a reflection while the lamp is missed.
    const double of_lamp =
        view_.detection(*predicted) * std::exp(ekf.log_density({lamp.at, image.seen[i]}) - log_reflection);
    lamp.evidence.seen(std::log(of_lamp + view_.chance_of_miss(*predicted)), 0.0);
  }
  for (const PredictedDirection& predicted : matches.predicted)
    if (book_[predicted.lamp].last_weighed != image_)
      book_[predicted.lamp].evidence.missed(std::log(view_.chance_of_miss(predicted)));
}

void LampMap::was_seen(std::size_t at) {
  Lamp& lamp = book_[at];
  ++lamp.sightings;
  lamp.missed_in_row = 0;
  lamp.last_image = image_;
  lamp.last_seen_m = path_m_;
  lamp.log_odds = std::min(lamp.log_odds + log_seen_, settings_.evidence.most_log_odds);
}

/// Distant lamps are not recorded, since merging never considers them.
void LampMap::note_apart(const LampMatches& matches) {
  for (std::size_t r = 0; r < matches.near.size(); ++r)
    for (std::size_t c = 0; c < r; ++c) {
      const PredictedDirection &a = matches.predicted[matches.near[r]], &b = matches.predicted[matches.near[c]];
      const Lamp &first = book_[a.lamp], &second = book_[b.lamp];
      if (first.last_image != image_ || second.last_image != image_) continue;
      if ((a.offset.m - b.offset.m).norm() > kNear || are_apart(first.id, second.id)) continue;
      apart_.push_back({std::min(first.id, second.id), std::max(first.id, second.id)});
    }
}

bool LampMap::are_apart(std::int64_t a, std::int64_t b) const {
  return std::ranges::any_of(apart_,
                             [&](const Apart& pair) { return pair.a == std::min(a, b) && pair.b == std::max(a, b); });
}

/// Counts only after some driving, since an occluded lamp stays occluded while the robot stands.
void LampMap::count_misses(const LampMatches& matches) {
  if (path_m_ - last_judged_m_ < settings_.evidence.judge_every_m) return;
  last_judged_m_ = path_m_;
  for (const PredictedDirection& predicted : matches.predicted) {
    Lamp& lamp = book_[predicted.lamp];
    if (lamp.last_image == image_ || !view_.is_in_view(predicted)) continue;
    lamp.log_odds += view_.log_missed();
    ++lamp.missed_in_row;
  }
}

void LampMap::tidy(LampEkf& ekf) {
  merge_twins(ekf);
  forget_doubtful(ekf);
}

/// Merges a lamp that is missed repeatedly with another lamp detected at the same place. Two lamps that one image
/// showed as two are never merged.
void LampMap::merge_twins(LampEkf& ekf) {
  if (settings_.merging.chi2 <= 0.0) return;
  for (std::size_t i = book_.size(); i-- > 0;) {
    if (book_[i].missed_in_row < settings_.merging.after_misses) continue;
    const std::optional<std::size_t> twin = twin_of(book_[i], ekf);
    if (!twin) continue;
    Lamp& kept = book_[*twin];
    ekf.merge(kept.at, book_[i].at);
    kept.sightings += book_[i].sightings;
    if (book_[i].evidence.proven()) kept.evidence = book_[i].evidence;
    kept.confirmed = kept.confirmed || book_[i].confirmed;
    forget(i);
  }
}

/// The only lamp detected now that may be the missed one; nullopt if there are several.
std::optional<std::size_t> LampMap::twin_of(const Lamp& missed, const LampEkf& ekf) const {
  std::optional<std::size_t> twin;
  if (missed.at.kind != BlockKind::point3) return twin;
  for (std::size_t i = 0; i < book_.size(); ++i) {
    const Lamp& other = book_[i];
    if (other.id == missed.id || other.at.kind != BlockKind::point3 || other.last_image != image_) continue;
    if (ekf.squared_distance(other.at, missed.at) > settings_.merging.chi2) continue;
    if (twin || are_apart(other.id, missed.id) || other.identity != missed.identity) return std::nullopt;
    twin = i;
  }
  return twin;
}

void LampMap::forget_doubtful(LampEkf& ekf) {
  for (std::size_t i = book_.size(); i-- > 0;) {
    const Lamp& lamp = book_[i];
    const bool unseen = !lamp.confirmed && path_m_ - lamp.last_seen_m > settings_.probation.drop_after_m;
    const bool none = lamp.log_odds < settings_.evidence.forget_log_odds || lamp.evidence.refuted();
    if (!none && !unseen && ekf.predict(lamp.at)) continue;
    ekf.remove(lamp.at);
    forget(i);
  }
}

/// If there is no room for all new lamps, initialises an evenly spaced selection. Bearings are ordered by azimuth, so
/// these lamps lie all round.
void LampMap::add(LampEkf& ekf, const CeilingImage& image, const LampMatches& matches) {
  const std::size_t on_probation = book_.size() - confirmed();
  const std::size_t room =
      std::min(room_below(settings_.max_landmarks, book_.size()), room_below(settings_.probation.most, on_probation));
  const auto fresh =
      static_cast<std::size_t>(std::ranges::count(matches.of, DirectionFate::fresh, &DirectionMatch::fate));
  const std::size_t begun = std::min(room, fresh);
  std::size_t met = 0;
  for (std::size_t i = 0; i < matches.of.size(); ++i) {
    if (matches.of[i].fate != DirectionFate::fresh) continue;
    if ((met + 1) * begun / fresh > met * begun / fresh) begin_lamp(ekf, image, i);
    ++met;
  }
}

void LampMap::begin_lamp(LampEkf& ekf, const CeilingImage& image, std::size_t direction) {
  Lamp lamp;
  lamp.identity = image.measured[direction].identity;
  lamp.at = ekf.add_lamp(image.seen[direction], inverse_height_per_m_, sigma_inverse_height_per_m_);
  if (lamp.identity != kUnknownIdentity) lamp.evidence = LampEvidence::certain();
  lamp.sightings = 1;
  lamp.first_seen_m = lamp.last_seen_m = path_m_;
  lamp.last_image = image_;
  book_.add(lamp);
}

bool LampMap::promote_converged(LampEkf& ekf) {
  const std::uint64_t before = created_;
  for (Lamp& lamp : book_.entries()) {
    if (lamp.at.kind != BlockKind::inverse_height) continue;
    const double nonlinearity = ekf.nonlinearity(lamp.at);
    if (nonlinearity < settings_.promote_nonlinearity) ekf.promote(lamp.at);
    if (!is_to_be_confirmed(lamp, nonlinearity)) continue;
    lamp.confirmed = true;
    ++created_;
  }
  return created_ != before;
}

/// Whether the lamp passes probation: it is proven, and detected often enough and from places far enough apart for its
/// height to be known.
bool LampMap::is_to_be_confirmed(const Lamp& lamp, double nonlinearity) const {
  const bool often = lamp.sightings >= static_cast<std::uint64_t>(settings_.probation.confirm_after_sightings);
  const bool apart = lamp.last_seen_m - lamp.first_seen_m >= settings_.probation.confirm_after_m;
  return !lamp.confirmed && lamp.evidence.proven() && often && apart &&
         nonlinearity < settings_.probation.confirm_nonlinearity;
}

void LampMap::forget(std::size_t at) {
  const std::int64_t id = book_[at].id;
  std::erase_if(apart_, [id](const Apart& pair) { return pair.a == id || pair.b == id; });
  deleted_ += book_[at].confirmed ? 1 : 0;
  book_.remove(at);
}

std::size_t LampMap::confirmed() const {
  return static_cast<std::size_t>(std::ranges::count_if(lamps(), &Lamp::confirmed));
}

/// The harmonic mean, because the inverse heights are nearly Gaussian.
std::optional<UsualHeight> LampMap::usual_height(const LampEkf& ekf) const {
  double sum_per_m = 0.0, sum_m = 0.0, sum_m2 = 0.0;
  for (const Lamp& lamp : lamps()) {
    if (!lamp.confirmed) continue;
    const double height_m = ekf.point(lamp.at).p_map_lamp_m.z() - ekf.camera_height_m();
    sum_per_m += 1.0 / height_m;
    sum_m += height_m;
    sum_m2 += height_m * height_m;
  }
  if (!(sum_per_m > 0.0)) return std::nullopt;
  const auto count = static_cast<double>(confirmed());
  return UsualHeight{count / sum_per_m, std::sqrt(std::max(0.0, sum_m2 / count - sum_m / count * sum_m / count))};
}

bool LampMap::any_proven() const {
  return std::ranges::any_of(lamps(), [](const Lamp& lamp) { return lamp.evidence.proven(); });
}

}  // namespace azimuth
