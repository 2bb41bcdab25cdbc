#include "slam/hypotheses/drawn_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kClutter = -1, kNew = -2;  // results of choose() beside an index of choices_
constexpr double kBearingGateChi2 = 9.0;
// A landmark is removed when the images that missed it are more than this and more than the images that showed it.
constexpr int kMostMissed = 12;
// Number of standard deviations of its azimuth by which a landmark must be in view to count as missed.
constexpr double kSurelyInView = 1.5;

constexpr std::uint64_t kSeed = 15;

/// Weights that sum to one.
std::vector<double> weights_of(std::span<const double> log_weights) {
  const double most = *std::ranges::max_element(log_weights);
  std::vector<double> weights;
  for (const double log_weight : log_weights) weights.push_back(std::exp(log_weight - most));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

/// The noise of the motion moves the robot but not the landmarks, so it changes the landmarks relative to the robot.
void DrawnMap::move(const Motion& motion) {
  const MovedPose moved = apply(pose_, motion);
  pose_ = moved.T_map_body;
  P_.topRows<kPose>() = (moved.G * P_.topRows<kPose>()).eval();
  P_.leftCols<kPose>() = (P_.leftCols<kPose>() * moved.G.transpose()).eval();
  Eigen::Matrix<double, Eigen::Dynamic, 3> by_noise(P_.rows(), 3);
  by_noise.topRows<kPose>().setIdentity();
  for (std::size_t i = 0; i < landmarks_.size(); ++i)
    by_noise.middleRows<2>(entry_of(i)) = -by_moving_all(landmarks_[i].where);
  P_.noalias() += by_noise * (moved.noise * by_noise.transpose());
}

/// d(alpha, rho) / d(shift of the landmark, turn about the robot), in a chart that stays fixed.
Eigen::Matrix<double, 2, 3> DrawnMap::by_moving_all(const SmoothedLandmark& landmark) const {
  const double rho = landmark.inverse_distance_per_m;
  const Eigen::Vector2d &u = landmark.direction, away = landmark.p_map_chart - pose_.position();
  const Eigen::Vector2d across(-u.y(), u.x()), turned(-away.y(), away.x());
  Eigen::Matrix<double, 2, 3> by;
  by << rho * across.transpose(), 1.0 + rho * across.dot(turned),  //
      -rho * rho * u.transpose(), -rho * rho * u.dot(turned);
  return by;
}

bool DrawnMap::predict(std::size_t landmark, double min_distance_m, Predicted& out) const {
  SeenAzimuth seen;
  if (!see(SmoothedPose(pose_), landmarks_[landmark].where, min_distance_m, seen)) return false;
  out.azimuth_rad = wrap(seen.azimuth_rad);
  out.by_landmark = seen.by_landmark;
  const Index at = entry_of(landmark);
  out.variance = out.by_landmark.dot(P_.block<2, 2>(at, at) * out.by_landmark);
  return true;
}

std::vector<char> DrawnMap::should_be_seen(const DrawnMapSettings& settings) const {
  std::vector<char> should(landmarks_.size(), 0);
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const SmoothedLandmark& landmark = landmarks_[i].where;
    Predicted predicted;
    if (!landmark.is_point() || !predict(i, settings.hypothesis.smoother.min_distance_m, predicted)) continue;
    if ((landmark.p_map() - pose_.position()).norm() > settings.hypothesis.scene.surely_seen_within_m()) continue;
    const double margin_rad = kSurelyInView * std::sqrt(predicted.variance);
    should[i] = settings.hypothesis.scene.sees_all_round() ||
                (settings.hypothesis.scene.in_view(predicted.azimuth_rad - margin_rad) &&
                 settings.hypothesis.scene.in_view(predicted.azimuth_rad + margin_rad) &&
                 margin_rad < 0.5 * settings.hypothesis.scene.field_of_view_rad);
  }
  return should;
}

double DrawnMap::take(std::span<const NamelessSighting> sightings, const DrawnMapSettings& settings, double now_s,
                      Draws& draws) {
  const std::vector<char> should = should_be_seen(settings);
  std::vector<char> taken(landmarks_.size(), 0);
  double log_density = 0.0;
  for (const NamelessSighting& sighting : sightings) {
    int chosen = kClutter;
    log_density += choose(sighting, settings, now_s, taken, draws, chosen);
    if (chosen == kClutter) continue;
    std::size_t landmark = 0;
    if (chosen == kNew) {
      landmark = add_landmark(sighting, settings);
      taken.push_back(1);
    } else {
      const Choice& choice = choices_[as_size(chosen)];
      landmark = choice.landmark;
      correct(choice);
      ++landmarks_[landmark].sightings;
      landmarks_[landmark].missed = 0;
      taken[landmark] = 1;
    }
    landmarks_[landmark].seen_s = now_s;
  }
  for (std::size_t i = 0; i < should.size(); ++i) {
    if (should[i] == 0 || taken[i] != 0) continue;
    log_density += std::log1p(-settings.hypothesis.scene.detection_probability);
    ++landmarks_[i].missed;
  }
  forget_some(settings, now_s);
  return log_density;
}

/// Draws the association of a bearing and returns ln of its density. `chosen` is kClutter, kNew, or an index of
/// choices_.
double DrawnMap::choose(const NamelessSighting& sighting, const DrawnMapSettings& settings, double now_s,
                        const std::vector<char>& taken, Draws& draws, int& chosen) {
  const double vague_rad = settings.vague_share_of_view * settings.hypothesis.scene.field_of_view_rad;
  choices_.clear();
  double total = settings.hypothesis.scene.clutter_per_rad + settings.hypothesis.scene.new_per_rad;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (taken[i] != 0 || !same_kind(sighting.kind, landmarks_[i].kind)) continue;
    Predicted predicted;
    if (!predict(i, settings.hypothesis.smoother.min_distance_m, predicted)) continue;
    const double off_rad = wrap(sighting.azimuth_rad - predicted.azimuth_rad);
    const double S = predicted.variance + sighting.sigma_rad * sighting.sigma_rad;
    if (!(off_rad * off_rad < kBearingGateChi2 * S)) continue;
    if (S > vague_rad * vague_rad && now_s - landmarks_[i].seen_s > settings.hypothesis.tracks.fresh_s) continue;
    const double density = settings.hypothesis.scene.detection_probability * std::exp(log_normal_density(off_rad, S));
    choices_.push_back({i, density, off_rad, S, predicted.by_landmark});
    total += density;
  }
  double drawn = draws.uniform() * total;
  chosen = kClutter;
  for (std::size_t c = 0; c < choices_.size(); ++c) {
    drawn -= choices_[c].density;
    if (drawn < 0.0) {
      chosen = static_cast<int>(c);
      break;
    }
  }
  if (chosen == kClutter && drawn < settings.hypothesis.scene.new_per_rad) chosen = kNew;
  return std::log(total);
}

void DrawnMap::correct(const Choice& choice) {
  const Eigen::VectorXd PH = P_.middleCols<2>(entry_of(choice.landmark)) * choice.by_landmark;
  move_by(PH * (choice.off_rad / choice.variance));
  P_.noalias() -= PH * (PH.transpose() / choice.variance);
}

/// Applies a correction. The charts move along with the robot.
void DrawnMap::move_by(const Eigen::VectorXd& step) {
  const Eigen::Vector2d from = pose_.position(), to = from + step.head<2>();
  const Eigen::Matrix2d turn = rotation(step(2));
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const SmoothedLandmark& was = landmarks_[i].where;
    const Index at = entry_of(i);
    landmarks_[i].where = {to + turn * (was.p_map_chart - from), was.direction_rad + step(2) + step(at),
                           was.inverse_distance_per_m + step(at + 1)};
  }
  pose_ = {to.x(), to.y(), wrap(pose_.heading_rad + step(2))};
}

/// Adds a landmark with its chart origin at the robot, so that its position relative to the robot depends on nothing
/// else.
std::size_t DrawnMap::add_landmark(const NamelessSighting& sighting, const DrawnMapSettings& settings) {
  const Index n = P_.rows();
  P_.conservativeResize(n + 2, n + 2);
  P_.rightCols<2>().setZero();
  P_.bottomRows<2>().setZero();
  P_(n, n) = sighting.sigma_rad * sighting.sigma_rad;
  P_(n + 1, n + 1) =
      settings.hypothesis.smoother.inverse_depth_sigma_per_m * settings.hypothesis.smoother.inverse_depth_sigma_per_m;
  const SmoothedLandmark where(pose_.position(), pose_.heading_rad + sighting.azimuth_rad,
                               settings.hypothesis.smoother.inverse_depth_mean_per_m);
  landmarks_.push_back({.where = where, .kind = sighting.kind});
  return landmarks_.size() - 1;
}

void DrawnMap::forget_some(const DrawnMapSettings& settings, double now_s) {
  std::vector<char> kept(landmarks_.size(), 1);
  std::size_t left = 0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    const bool was_nothing = as_size(landmark.sightings) < settings.hypothesis.tracks.fewest_bearings &&
                             now_s - landmark.seen_s > settings.hypothesis.tracks.fresh_s;
    const bool is_not_there = landmark.missed > kMostMissed && landmark.missed > landmark.sightings;
    kept[i] = was_nothing || is_not_there ? 0 : 1;
    left += as_size(kept[i]);
  }
  for (; left > as_size(settings.most_landmarks); --left) {
    std::size_t oldest = landmarks_.size();
    for (std::size_t i = 0; i < landmarks_.size(); ++i)
      if (kept[i] != 0 && (oldest == landmarks_.size() || landmarks_[i].seen_s < landmarks_[oldest].seen_s)) oldest = i;
    kept[oldest] = 0;
  }
  keep_only(kept);
}

void DrawnMap::keep_only(const std::vector<char>& kept) {
  if (std::ranges::find(kept, 0) == kept.end()) return;
  std::vector<Index> entries{0, 1, 2};
  std::vector<Landmark> left;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (kept[i] == 0) continue;
    left.push_back(std::move(landmarks_[i]));
    entries.push_back(entry_of(i));
    entries.push_back(entry_of(i) + 1);
  }
  P_ = P_(entries, entries).eval();
  landmarks_ = std::move(left);
}

DrawnMaps::DrawnMaps(const DrawnMapsSettings& settings) : settings_(settings) {
  const std::size_t members = as_size(settings.members);
  for (int i = 0; i < settings.populations; ++i)
    populations_.push_back({Draws(Xoshiro(mixed_bits(kSeed + static_cast<std::uint64_t>(i)))),
                            std::vector<DrawnMap>(members), std::vector<double>(members, 0.0)});
}

void DrawnMaps::begin(std::span<const NamelessSighting> sightings, Workers& workers) {
  take(sightings, workers, nullptr);
}

void DrawnMaps::add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers,
                          double after_s) {
  now_s_ += after_s;
  take(sightings, workers, &motion);
}

void DrawnMaps::take(std::span<const NamelessSighting> sightings, Workers& workers, const Motion* motion) {
  workers.for_each(populations_.size(), [&](std::size_t p) {
    Population& population = populations_[p];
    for (std::size_t i = 0; i < population.maps.size(); ++i) {
      DrawnMap& map = population.maps[i];
      if (motion != nullptr) map.move(*motion);
      population.log_weights[i] += map.take(sightings, settings_.map, now_s_, population.draws);
    }
    weigh(population);
  });
  conclude();
}

void DrawnMaps::weigh(Population& population) {
  const std::vector<double> weights = weights_of(population.log_weights);
  std::vector<BelievedPose> beliefs;
  for (const DrawnMap& map : population.maps) beliefs.push_back({map.pose(), map.pose_covariance()});
  population.belief = mixture(beliefs, weights, beliefs.front().T_map_body);
  const double of_squares = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  if (of_squares * static_cast<double>(weights.size()) > 2.0) resample(population);
}

/// Systematic resampling: a map of weight w gets floor(n w) or ceil(n w) copies.
void DrawnMaps::resample(Population& population) {
  const std::vector<double> weights = weights_of(population.log_weights);
  const auto count = static_cast<double>(weights.size());
  double at = population.draws.uniform() / count, cumulated = weights[0];
  std::size_t from = 0;
  std::vector<DrawnMap> maps;
  for (std::size_t i = 0; i < weights.size(); ++i, at += 1.0 / count) {
    while (cumulated < at && from + 1 < weights.size()) cumulated += weights[++from];
    maps.push_back(population.maps[from]);
  }
  population.maps = std::move(maps);
  std::ranges::fill(population.log_weights, 0.0);
}

void DrawnMaps::conclude() {
  const std::vector<double> alike(populations_.size(), 1.0 / static_cast<double>(populations_.size()));
  std::vector<BelievedPose> beliefs;
  for (const Population& population : populations_) beliefs.push_back(population.belief);
  belief_ = mixture(beliefs, alike, beliefs.front().T_map_body);
}

}  // namespace azimuth
