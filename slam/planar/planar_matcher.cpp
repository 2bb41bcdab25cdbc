#include "slam/planar/planar_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/estimator/estimate.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kUngated = 1e9, kUngatedProbability = 0.9999;
constexpr double kUndisputed_sigmas = 3.0;
constexpr double kJolt_chi2 = 36.0, kJoltProbability = 0.999999;
constexpr std::uint64_t kConfirmed = 3;  // bearings of a landmark that should be seen again
constexpr int kNodesOfMany = 500;
constexpr std::size_t kBeamOfMany = 64;

/// Whether an earlier bearing of the image has the same name.
bool repeats_a_name(const Bearing& bearing, const BearingSet& image) {
  return &*std::ranges::find(image.bearings, bearing.identity, &Bearing::identity) != &bearing;
}

}  // namespace

std::size_t PlanarMatches::rejected() const { return as_size(std::ranges::count(pairs, false, &Pair::accepted)); }

PlanarMatcher::PlanarMatcher(const EkfSettings& settings, double new_density_per_rad) : settings_(settings) {
  gates_.individual_chi2 = settings.gates.chi2 > 0.0 ? settings.gates.chi2 : kUngated;
  gates_.joint_probability =
      settings.gates.joint_probability > 0.0 ? settings.gates.joint_probability : kUngatedProbability;
  gates_.new_density_per_rad = new_density_per_rad;
  gates_.rival_log_ratio = settings.unnamed.rival_log_ratio;
  matches_.pairs.reserve(kTypicalLandmarks);
  matches_.unmapped.reserve(kTypicalLandmarks);
  measured_.reserve(kTypicalLandmarks);
  visible_.reserve(kTypicalLandmarks);
  visible_azimuths_rad_.reserve(kTypicalLandmarks);
  visible_kinds_.reserve(kTypicalLandmarks);
  gated_.reserve(kTypicalLandmarks);
  innovations_.reserve(kTypicalLandmarks);
}

const PlanarMatches& PlanarMatcher::match_names(const BearingSet& image, Landmarks landmarks, const PlanarView& view) {
  begin(image, view);
  for (const Bearing& bearing : image.bearings) {
    if (bearing.identity == kUnknownIdentity) continue;
    if (repeats_a_name(bearing, image)) {
      ++matches_.repeated;
      continue;
    }
    const auto known = std::ranges::find(landmarks, bearing.identity, &PlanarLandmark::identity);
    if (known == landmarks.end())
      matches_.unmapped.push_back(bearing);
    else
      add_pair(as_size(known - landmarks.begin()), bearing, image.stamp, landmarks, view);
  }
  gate(view);
  return matches_;
}

const PlanarMatches& PlanarMatcher::match_places(const BearingSet& image, Landmarks landmarks, const PlanarView& view) {
  associate(image, landmarks, view, gates_);
  return matches_of_pairings(image, landmarks, view);
}

const JointCompatibility& PlanarMatcher::weigh(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                               double keep_log_ratio) {
  JointGates gates = gates_;
  gates.keep_log_ratio = keep_log_ratio;
  gates.max_nodes = kNodesOfMany;
  gates.beam_width = kBeamOfMany;
  associate(image, landmarks, view, gates);
  return association_;
}

const PlanarMatches& PlanarMatcher::match_weighed(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                                  std::size_t hypothesis) {
  matches_.clear();
  std::ranges::transform(association_.choices(hypothesis), pairings_.begin(), [](int landmark) {
    return Pairing{landmark, false};
  });
  return matches_of_pairings(image, landmarks, view);
}

/// When the robot turned farther than odometry said, no landmark is where it should be in the image, although all are
/// off by the same angle. Such an image is associated again with wider gates.
void PlanarMatcher::associate(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                              const JointGates& gates) {
  begin(image, view);
  associate_within(landmarks, view, gates);
  if (settings_.gates.chi2 <= 0.0 || !shows_other_things(image, landmarks)) return;
  jolted_ = true;
  JointGates wide = gates;
  wide.individual_chi2 = std::max(kJolt_chi2, gates.individual_chi2);
  wide.joint_probability = std::max(kJoltProbability, gates.joint_probability);
  associate_within(landmarks, view, wide);
}

void PlanarMatcher::associate_within(Landmarks landmarks, const PlanarView& view, const JointGates& gates) {
  predict_visible(landmarks, view, gates.individual_chi2);
  const auto size = as_index(visible_.size());
  const PredictedAzimuths predicted{visible_azimuths_rad_, innovation_covariance_.matrix(size, size), visible_kinds_};
  association_.associate(measured_, predicted, gates, pairings_);
}

/// Whether fewer than half of the bearings that landmarks could explain are explained. Landmarks could explain as many
/// bearings as the smaller of two numbers: that of the bearings and that of the landmarks just seen.
bool PlanarMatcher::shows_other_things(const BearingSet& image, Landmarks landmarks) const {
  const auto confirmed = [](const PlanarLandmark& landmark) {
    return landmark.is_point() && landmark.sightings >= kConfirmed;
  };
  Stamp newest = Stamp::min();
  for (const PlanarLandmark& landmark : landmarks)
    if (confirmed(landmark)) newest = std::max(newest, landmark.last_used);
  const auto just_seen = as_size(std::ranges::count_if(landmarks, [&](const PlanarLandmark& landmark) {
    return confirmed(landmark) && newest - landmark.last_used <= duration_from_seconds(settings_.thinning_s);
  }));
  const auto explained = as_size(std::ranges::count_if(
      pairings_, [](const Pairing& pairing) { return pairing.landmark != kNoLandmark || pairing.ambiguous; }));
  return 2 * explained < std::min(just_seen, image.bearings.size());
}

const PlanarMatches& PlanarMatcher::matches_of_pairings(const BearingSet& image, Landmarks landmarks,
                                                        const PlanarView& view) {
  for (std::size_t i = 0; i < pairings_.size(); ++i) {
    const Bearing& bearing = image.bearings[i];
    if (pairings_[i].landmark != kNoLandmark)
      add_pair(visible_[as_size(pairings_[i].landmark)].landmark, bearing, image.stamp, landmarks, view);
    else if (pairings_[i].ambiguous)
      ++matches_.ambiguous;
    else
      matches_.unmapped.push_back(bearing);
  }
  gate(view);
  return matches_;
}

const PlacedSightings& PlanarMatcher::named_points(const BearingSet& image, Landmarks landmarks,
                                                   const PlanarView& view) {
  placed_.clear();
  for (const Bearing& bearing : image.bearings)
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      if (bearing.identity != kUnknownIdentity && landmarks[i].identity == bearing.identity &&
          landmarks[i].is_point() && !repeats_a_name(bearing, image))
        placed_.add(i, view.sighting_of(landmarks[i], bearing));
  return placed_;
}

const PlacedSightings& PlanarMatcher::undisputed_points(const BearingSet& image, Landmarks landmarks,
                                                        const PlanarView& view, bool named) {
  placed_.clear();
  begin(image, view);
  predict_visible(landmarks, view, gates_.individual_chi2);
  for (const Bearing& bearing : image.bearings) {
    std::size_t candidates = 0, only = 0;
    for (const Visible& visible : visible_) {
      const PlanarLandmark& landmark = landmarks[visible.landmark];
      const double variance_rad2 = visible.predicted.variance_rad2 + view.variance_rad2(bearing);
      const double innovation_rad = wrap(bearing.azimuth_rad - visible.predicted.azimuth_rad);
      const bool named_otherwise = named && bearing.identity != landmark.identity;
      if (named_otherwise || !same_kind(bearing.kind, landmark.kind) || !landmark.is_point() ||
          innovation_rad * innovation_rad > kUndisputed_sigmas * kUndisputed_sigmas * variance_rad2)
        continue;
      ++candidates;
      only = visible.landmark;
    }
    if (candidates != 1 || std::ranges::find(placed_.landmarks, only) != placed_.landmarks.end()) continue;
    placed_.add(only, view.sighting_of(landmarks[only], bearing));
  }
  return placed_;
}

void PlanarMatcher::begin(const BearingSet& image, const PlanarView& view) {
  matches_.clear();
  jolted_ = false;
  measured_.clear();
  for (const Bearing& bearing : image.bearings)
    measured_.push_back({bearing.azimuth_rad, view.variance_rad2(bearing), bearing.kind});
}

/// Collects the landmarks within the gate of some measured azimuth, with the joint covariance of their predicted
/// azimuths.
void PlanarMatcher::predict_visible(Landmarks landmarks, const PlanarView& view, double gate_chi2) {
  visible_.clear();
  visible_azimuths_rad_.clear();
  visible_kinds_.clear();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (!view.reaches(landmarks[i])) continue;
    const auto predicted = view.predict(landmarks[i]);
    if (!predicted) continue;
    const bool expected = std::ranges::any_of(measured_, [&](const MeasuredAzimuth& measured) {
      const double innovation_rad = wrap(measured.azimuth_rad - predicted->azimuth_rad);
      return same_kind(measured.kind, landmarks[i].kind) &&
             innovation_rad * innovation_rad < gate_chi2 * (predicted->variance_rad2 + measured.variance_rad2);
    });
    if (!expected) continue;
    visible_.push_back({i, *predicted});
    visible_azimuths_rad_.push_back(predicted->azimuth_rad);
    visible_kinds_.push_back(landmarks[i].kind);
  }
  const auto size = as_index(visible_.size());
  auto covariance = innovation_covariance_.matrix(size, size);
  for (Index r = 0; r < size; ++r) {
    const PlanarView::Predicted& a = visible_[as_size(r)].predicted;
    for (Index c = 0; c < r; ++c)
      covariance(r, c) = covariance(c, r) = view.ekf().prediction_covariance(a.row, visible_[as_size(c)].predicted.row);
    covariance(r, r) = a.variance_rad2;
  }
}

void PlanarMatcher::add_pair(std::size_t at, const Bearing& bearing, Stamp stamp, Landmarks landmarks,
                             const PlanarView& view) {
  const PlanarLandmark& landmark = landmarks[at];
  if (landmark.sightings > 0 && stamp - landmark.last_used < duration_from_seconds(settings_.thinning_s)) {
    ++matches_.thinned;
    return;
  }
  const MappedSighting sighting = view.sighting_of(landmark, bearing);
  const auto row = view.ekf().linearise(sighting);
  if (!row) return;
  const double noise_rad2 = sighting.variance_rad2 + view.ekf().curvature_rad2(sighting);
  matches_.pairs.push_back({at, sighting, *row, view.ekf().prediction_covariance(*row, *row) + noise_rad2});
}

void PlanarMatcher::gate(const PlanarView& view) {
  if (settings_.gates.chi2 > 0.0) gate_individually();
  if (settings_.gates.joint_probability > 0.0) gate_jointly(view);
}

void PlanarMatcher::gate_individually() {
  const double chi2 = jolted_ ? std::max(kJolt_chi2, settings_.gates.chi2) : settings_.gates.chi2;
  for (PlanarMatches::Pair& pair : matches_.pairs)
    pair.accepted = pair.row.innovation * pair.row.innovation < chi2 * pair.variance_rad2;
}

void PlanarMatcher::gate_jointly(const PlanarView& view) {
  gated_.clear();
  innovations_.clear();
  for (std::size_t i = 0; i < matches_.pairs.size(); ++i) {
    if (!matches_.pairs[i].accepted) continue;
    gated_.push_back(i);
    innovations_.push_back(matches_.pairs[i].row.innovation);
  }
  const auto size = as_index(gated_.size());
  if (size < 2) return;
  auto S = innovation_covariance_.matrix(size, size);
  for (Index r = 0; r < size; ++r)
    for (Index c = 0; c <= r; ++c) {
      const PlanarMatches::Pair& a = matches_.pairs[gated_[as_size(r)]];
      const PlanarMatches::Pair& b = matches_.pairs[gated_[as_size(c)]];
      S(r, c) = S(c, r) = r == c ? a.variance_rad2 : view.ekf().prediction_covariance(a.row, b.row);
    }
  const double usual = settings_.gates.joint_probability;
  joint_test_.prune(innovations_, S, jolted_ ? std::max(kJoltProbability, usual) : usual, jointly_accepted_);
  for (std::size_t i = 0; i < gated_.size(); ++i) matches_.pairs[gated_[i]].accepted = jointly_accepted_[i] != 0;
}

}  // namespace azimuth
