#include "slam/planar/planar_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/estimator/rig_noise.hpp"
#include "slam/lost/lost_robot.hpp"
#include "slam/planar/ekf_choices.hpp"

namespace azimuth {
namespace {

constexpr double kGate_sigmas = 3.0;
constexpr double kApart_rad = 0.03;
constexpr double kUsual = 0.95;  // share of recognised landmarks within the usual range
constexpr double kReach = 1.5;   // times the usual range
constexpr int kFewestRecognised = 50;
constexpr double kRangeStep = 0.05;  // relative change per recognised landmark
constexpr double kInnerView = 0.9;   // share of the field of view in which landmarks are expected
constexpr double kNamedByAccident = 0.05;
constexpr double kSlackRange = 1.25;  // times the distance of the farthest landmark seen lately

/// Whether the image has a bearing with the landmark's name.
bool shows(const BearingSet& image, const PlanarLandmark& landmark) {
  return std::ranges::find(image.bearings, landmark.identity, &Bearing::identity) != image.bearings.end();
}

}  // namespace

PlanarSearch::PlanarSearch(const Rig& rig, const EkfSettings& settings, const RelocalisationSettings& relocalisation)
    : rig_(rig),
      settings_(settings),
      detection_probability_(relocalisation.detection_probability),
      named_(names_landmarks(rig)),
      by_looks_(names_by_looks(rig)) {}

/// Whether the landmark should be in the image. It is unknown which landmarks of a saved map were in view when it was
/// saved: a landmark that is missing in the image need not be in view, and a landmark that is present must be where it
/// should be. Without names its presence cannot be known.
bool PlanarSearch::is_due(const PlanarLandmark& landmark, const BearingSet& image, double path_m) const {
  if (landmark.recalled && named_) return shows(image, landmark);
  return path_m - landmark.last_used_m < kMoment_m && (named_ || was_in_one_of_the_last(landmark));
}

/// Whether the landmark was seen in one of the last images. A robot that goes through a door loses sight of one
/// landmark after the other while the others stay where they should be; a robot that is carried away loses sight of all
/// at once.
bool PlanarSearch::was_in_one_of_the_last(const PlanarLandmark& landmark) const {
  return images_ < kLastImages || landmark.last_used >= last_images_[images_ % kLastImages];
}

bool PlanarSearch::is_established(const PlanarLandmark& landmark) const {
  return landmark.sightings >= static_cast<std::uint64_t>(settings_.probation.confirm_after_sightings);
}

/// Whether the landmark is within the usual range. Landmarks beyond this range are missed merely because they are far
/// and hence small in the image.
bool PlanarSearch::is_in_range(const PlanarLandmark& landmark, const JointState& state) const {
  if (!landmark.is_point() || usual_range_m_ == 0.0) return true;
  return (state.position(landmark.block) - state.pose().position()).norm() < usual_range_m_;
}

bool PlanarSearch::is_in_view(const Prediction& prediction) const {
  return std::abs(prediction.azimuth_rad) < kInnerView * 0.5 * rig_.camera.field_of_view_rad;
}

ImageAgreement PlanarSearch::agreement(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                       double path_m, bool in_doubt) {
  // Among landmarks in the plane that are all alike a search finds wrong poses.
  const auto alike = [](const Bearing& bearing) { return bearing.kind == kAnyKind; };
  if (!named_ && std::ranges::all_of(image.bearings, alike)) return {};
  const auto counts = [this](const PlanarLandmark& landmark) {
    return landmark.is_point() && is_established(landmark);
  };
  if (static_cast<std::size_t>(std::ranges::count_if(landmarks, counts)) < kFewestEstablished) return {};
  predict(image, landmarks, view, path_m);
  if (!in_doubt) last_images_[images_++ % kLastImages] = image.stamp;
  ImageAgreement agreement;
  explained_.assign(image.bearings.size(), Explained::not_at_all);
  double width_rad = 0.0, width_of_all_rad = 0.0;
  for (const Prediction& prediction : predictions_) {
    mark_explained(image, prediction);
    if (!prediction.apart) continue;
    width_of_all_rad += 2.0 * prediction.gate_rad;
    if (!prediction.due || !is_in_view(prediction)) continue;
    ++agreement.expected;
    width_rad += 2.0 * prediction.gate_rad;
  }
  agreement.explained = static_cast<int>(std::ranges::count(explained_, Explained::by_one_apart));
  if (agreement.expected == 0) {  // nothing can contradict the pose, only confirm it
    agreement.expected = agreement.explained;
    width_rad = width_of_all_rad;
  }
  agreement.bearings = static_cast<int>(std::ranges::count(explained_, Explained::not_at_all)) + agreement.explained;
  agreement.chance =
      named_ ? kNamedByAccident : 1.0 - std::exp(-width_rad / std::min(2.0 * kPi, rig_.camera.field_of_view_rad));
  return agreement;
}

ImageAgreement PlanarSearch::agreement_of_features(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                                   double path_m, bool in_doubt) {
  if (!in_doubt)
    seen_again_.learn();
  else
    seen_again_.pass_over();
  looks_.clear();
  const double view_rad = std::min(2.0 * kPi, rig_.camera.field_of_view_rad);
  const bool all_round = view_rad >= 2.0 * kPi;
  for (const PlanarLandmark& landmark : landmarks) {
    const bool shown = shows(image, landmark);
    // It is unknown which landmarks of a saved map were in view when it was saved.
    if (!shown && landmark.recalled) continue;
    if (!shown && all_round) {  // most of the map: its direction is not needed
      looks_.push_back({landmark.id, landmark.sightings, false, 0.0});
      continue;
    }
    const auto predicted = view.predict(landmark);
    if (!predicted) continue;
    const Prediction prediction = prediction_of(landmark, *predicted, true);
    const bool seen = shows_there(image, prediction);
    if (!seen && !is_in_view(prediction)) continue;
    looks_.push_back({landmark.id, landmark.sightings, seen, std::min(1.0, 2.0 * prediction.gate_rad / view_rad)});
  }
  if (looks_.size() < kFewestEstablished) return {};
  const double log_odds = seen_again_.weigh(looks_, path_m, static_cast<int>(image.bearings.size()));
  return {.expected = static_cast<int>(std::lround(seen_again_.expected())), .log_odds = log_odds};
}

PlanarSearch::Prediction PlanarSearch::prediction_of(const PlanarLandmark& landmark,
                                                     const PlanarView::Predicted& predicted, bool due) {
  const double gate_rad = kGate_sigmas * std::sqrt(predicted.variance_rad2 + predicted.row.variance);
  return {&landmark, predicted.azimuth_rad, gate_rad, due, true};
}

void PlanarSearch::predict(const BearingSet& image, Landmarks landmarks, const PlanarView& view, double path_m) {
  predictions_.clear();
  for (const PlanarLandmark& landmark : landmarks) {
    if (!is_established(landmark)) continue;
    const bool due = is_due(landmark, image, path_m) && (named_ || is_in_range(landmark, view.ekf().state()));
    if (!due && named_ && !shows(image, landmark)) continue;
    const auto predicted = view.predict(landmark);
    if (!predicted) continue;
    predictions_.push_back(prediction_of(landmark, *predicted, due));
  }
  if (!named_) tell_apart();
}

/// Marks landmarks that are near each other in direction. One may occlude the other, or the image shows both as one
/// blob of another kind, so missing them means nothing. Names do not need this: a name is read only off a fully visible
/// landmark.
void PlanarSearch::tell_apart() {
  std::ranges::sort(predictions_, {}, &Prediction::azimuth_rad);
  const std::size_t count = predictions_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Prediction &one = predictions_[i], &next = predictions_[(i + 1) % count];
    if (&one != &next && std::abs(wrap(next.azimuth_rad - one.azimuth_rad)) < kApart_rad)
      one.apart = next.apart = false;
  }
}

void PlanarSearch::mark_explained(const BearingSet& image, const Prediction& prediction) {
  const PlanarLandmark& landmark = *prediction.landmark;
  const Explained explains = prediction.apart ? Explained::by_one_apart : Explained::by_one_beside_another;
  for (std::size_t b = 0; b < explained_.size(); ++b) {
    const Bearing& bearing = image.bearings[b];
    if (named_ ? bearing.identity != landmark.identity : !same_kind(bearing.kind, landmark.kind)) continue;
    if (std::abs(wrap(bearing.azimuth_rad - prediction.azimuth_rad)) < prediction.gate_rad)
      explained_[b] = std::max(explained_[b], explains);
  }
}

bool PlanarSearch::shows_there(const BearingSet& image, const Prediction& prediction) {
  return std::ranges::any_of(image.bearings, [&](const Bearing& bearing) {
    return bearing.identity == prediction.landmark->identity &&
           std::abs(wrap(bearing.azimuth_rad - prediction.azimuth_rad)) < prediction.gate_rad;
  });
}

void PlanarSearch::note_range(double distance_m) {
  constexpr double kForgetting = 0.9999;
  seen_range_m_ = std::max(kForgetting * seen_range_m_, distance_m);
  // Stochastic approximation of the quantile: steps up and down balance at kUsual (Robbins, Monro 1951).
  ++recognised_;
  if (usual_range_m_ == 0.0) usual_range_m_ = distance_m;
  usual_range_m_ *= std::exp(kRangeStep * (distance_m > usual_range_m_ ? kUsual : kUsual - 1.0));
}

double PlanarSearch::reach_m() const {
  if (named_ || rig_.front_end != FrontEnd::colour || recognised_ < kFewestRecognised)
    return std::numeric_limits<double>::infinity();
  return kReach * usual_range_m_;
}

std::vector<KnownLandmark> PlanarSearch::known(Landmarks landmarks, const JointState& state) {
  std::vector<KnownLandmark> known;
  for (const PlanarLandmark& landmark : landmarks) {
    if (!landmark.is_point()) continue;
    KnownLandmark& entry = known.emplace_back();
    const Eigen::Vector2d p = state.position(landmark.block);
    entry.p_map_m = {p.x(), p.y(), std::numeric_limits<double>::quiet_NaN()};
    entry.covariance_m2.topLeftCorner<2, 2>() = state.position_covariance(landmark.block);
    entry.identity = landmark.identity;
    entry.kind = landmark.kind;
  }
  return known;
}

CameraView PlanarSearch::camera_view(const BearingEkf& ekf) const {
  CameraView view;
  view.yaw_rad = ekf.yaw_offset_rad();
  view.field_of_view_rad = std::min(2.0 * kPi, rig_.camera.field_of_view_rad);
  view.detection_probability = detection_probability_;
  view.max_distance_m = settings_.max_viewing_distance_m;
  if (seen_range_m_ > 0.0) view.max_distance_m = std::min(view.max_distance_m, kSlackRange * seen_range_m_);
  return view;
}

std::span<const SeenDirection> PlanarSearch::directions(const BearingSet& image, Landmarks landmarks,
                                                        const BearingEkf& ekf) {
  directions_.clear();
  for (const Bearing& bearing : image.bearings) {
    // Newly assigned identities match nothing in the map, and would be most of the directions.
    if (by_looks_ && std::ranges::find(landmarks, bearing.identity, &PlanarLandmark::identity) == landmarks.end())
      continue;
    const Sighting seen = ekf.sighting_from(JointState::kPose, bearing.azimuth_rad, bearing.radius_px);
    SeenDirection& direction = directions_.emplace_back();
    direction.azimuth_rad = wrap(seen.azimuth_rad);
    direction.sigma_rad = sigma_rad(bearing, rig_.camera);
    direction.identity = bearing.identity;
    direction.kind = bearing.kind;
  }
  return directions_;
}

}  // namespace azimuth
