#include "slam/hypotheses/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

const double kSqrtTwoPi = std::sqrt(2.0 * std::numbers::pi);
// Lower bound of a cost, since a hypothesis may be wrong even about clear odds.
constexpr double kLeastCost = 0.1;

// Minimum number of bearings of a landmark that contributes to the range.
constexpr std::size_t kFewestBearingsToTell = 5;
// Number of images before a landmark's first and after its last bearing that count as evidence, since the landmark
// comes into or goes out of range in these images. In images further off, a second copy of the landmark may have been
// mapped.
constexpr PoseId kImagesAround = 12;
// Probability that another bearing is taken for a landmark that is not seen.
constexpr double kFalselySeen = 0.02;

/// Evidence for the range from detections and missed detections, in steps of the logarithm of the distance.
class RangeEvidence {
 public:
  RangeEvidence(double given_m, double detection_probability)
      : given_m_(given_m),
        seen_(std::log(detection_probability / kFalselySeen)),
        missed_(std::log((1.0 - detection_probability) / (1.0 - kFalselySeen))) {}

  double furthest_m() const { return given_m_ * std::exp(kStep * kStepsEachWay); }
  /// Adds a detection or a missed detection of a landmark at this distance, which must be below furthest_m().
  void add(double distance_m, bool seen) {
    const double steps = std::log(distance_m / given_m_) / kStep;
    const double at = std::clamp(std::ceil(steps) + kStepsEachWay, 0.0, kSteps - 1.0);
    log_likelihoods_[static_cast<std::size_t>(at)] += seen ? seen_ : missed_;
  }

  /// The range from mean and standard deviation of its logarithm. The prior standard deviation is the given doubt
  /// beyond kLeastRangeDoubt.
  RangeBelief range(double given_doubt) const {
    const double given_deviation = given_doubt - Scene::kLeastRangeDoubt;
    if (!(given_deviation > 0.0)) return {given_m_, given_doubt};
    std::array<double, kSteps> log_density{};
    double log_likelihood = 0.0;
    for (std::size_t i = 0; i < kSteps; ++i) {
      const double deviations = log_ratio(i) / given_deviation;
      log_likelihood += log_likelihoods_[i];
      log_density[i] = log_likelihood - 0.5 * deviations * deviations;
    }
    const double highest = *std::max_element(log_density.begin(), log_density.end());
    double sum = 0.0, first = 0.0, second = 0.0;
    for (std::size_t i = 0; i < kSteps; ++i) {
      const double density = std::exp(log_density[i] - highest), x = log_ratio(i);
      sum += density;
      first += density * x;
      second += density * x * x;
    }
    const double mean = first / sum;
    const double deviation = std::sqrt(std::max(second / sum - mean * mean, 0.0));
    return {given_m_ * std::exp(mean), Scene::kLeastRangeDoubt + deviation};
  }

 private:
  static constexpr double kStep = 0.03;
  static constexpr int kStepsEachWay = 30;
  static constexpr std::size_t kSteps = 2 * kStepsEachWay + 1;
  static double log_ratio(std::size_t i) { return kStep * (static_cast<double>(i) - kStepsEachWay); }

  double given_m_, seen_, missed_;
  std::array<double, kSteps> log_likelihoods_{};  // contribution to all ranges of this step or more
};

bool in_view(const Scene& scene, const SmoothedPose& pose, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d away = pose.to_body(p_map - pose.T_map_body.position());
  return scene.in_view(std::atan2(away.y(), away.x()));
}

}  // namespace

bool Scene::sees_all_round() const { return field_of_view_rad > 2.0 * std::numbers::pi - 1e-6; }

double Scene::images_for_all_round() const {
  return sees_all_round() ? 1.0 : 2.0 * std::numbers::pi / field_of_view_rad;
}

bool Scene::in_view(double azimuth_rad) const {
  return sees_all_round() || std::abs(std::remainder(azimuth_rad, 2.0 * std::numbers::pi)) <= 0.5 * field_of_view_rad;
}

/// A bearing of a landmark has the density p_D N(r; sigma^2), clutter has lambda_c. The cost of an unassigned bearing
/// is ln of their ratio at r = 0. A landmark has a prior density lambda_n by direction and N(rho_0, sigma_0^2) by
/// inverse distance. Its bearings reduce this to standard deviations of about sigma by direction and sigma rho_0 by
/// inverse distance, for a parallax of about a radian (Laplace's approximation of the evidence).
HypothesisCosts hypothesis_costs(const Scene& scene, const SmootherSettings& smoother) {
  const double sigma = scene.sigma_bearing_rad, rho_0 = smoother.inverse_depth_mean_per_m;
  HypothesisCosts costs;
  costs.unassigned = std::log(scene.detection_probability / (kSqrtTwoPi * sigma * scene.clutter_per_rad));
  costs.landmark =
      -std::log(kSqrtTwoPi * scene.new_per_rad * sigma * (sigma * rho_0) / smoother.inverse_depth_sigma_per_m);
  costs.missed = -std::log1p(-scene.detection_probability);
  costs.unassigned = std::max(costs.unassigned, kLeastCost);
  costs.landmark = std::max(costs.landmark, kLeastCost);
  return costs;
}

/// The widest of n directions within +-a is below a 0.05^(1/n) with a probability of 5 %.
double field_of_view_by_experience(double given_rad, const BearingGraph& graph) {
  constexpr double kUnlikely = 0.05;
  constexpr int kFewestToJudgeBy = 20;
  if (graph.bearings() < kFewestToJudgeBy) return given_rad;
  double widest_rad = 0.0;
  for (BearingId id = 0; id < graph.bearings(); ++id)
    widest_rad = std::max(widest_rad, std::abs(graph.bearing(id).azimuth_rad));
  const double n = graph.bearings();
  return std::min(given_rad, 2.0 * widest_rad * std::pow(kUnlikely, -1.0 / n));
}

RangeBelief range_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks) {
  RangeEvidence evidence(given.range_m, given.detection_probability);
  const double furthest2_m2 = evidence.furthest_m() * evidence.furthest_m();
  std::vector<char> is_seen_from(as_size(graph.poses()));
  for (const LandmarkId id : landmarks) {
    const std::vector<BearingId>& bearings = graph.bearings_of(id);
    if (bearings.size() < kFewestBearingsToTell || !graph.landmark(id).is_point()) continue;
    PoseId first = graph.poses(), last = 0;
    for (const BearingId bearing : bearings) {
      const PoseId pose = graph.bearing(bearing).pose;
      is_seen_from[as_size(pose)] = 1;
      first = std::min(first, pose);
      last = std::max(last, pose);
    }
    const Eigen::Vector2d p = graph.landmark(id).p_map();
    const PoseId begin = std::max(first - kImagesAround, 0), end = std::min(last + kImagesAround + 1, graph.poses());
    for (PoseId from = begin; from < end; ++from) {
      const double distance2_m2 = (p - graph.camera_at(from).T_map_body.position()).squaredNorm();
      if (distance2_m2 >= furthest2_m2) continue;
      const bool seen = is_seen_from[as_size(from)] != 0;
      if (seen || in_view(given, graph.camera_at(from), p)) evidence.add(std::sqrt(distance2_m2), seen);
    }
    for (const BearingId bearing : bearings) is_seen_from[as_size(graph.bearing(bearing).pose)] = 0;
  }
  return evidence.range(given.range_doubt);
}

Scene scene_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks) {
  Scene scene = given;
  scene.field_of_view_rad = field_of_view_by_experience(given.field_of_view_rad, graph);
  if (given.is_narrow()) return scene;
  const RangeBelief range = range_by_experience(scene, graph, landmarks);
  scene.range_m = range.range_m;
  scene.range_doubt = range.doubt;
  return scene;
}

}  // namespace azimuth
