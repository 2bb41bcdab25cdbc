#include "slam/map_merge/overlap_odds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slam/map_merge/overlap_search.hpp"

namespace azimuth {
namespace {

constexpr int kMostExchanges = 30;
// The 99.99 % quantile of chi squared with two and three degrees of freedom. Two halls have dozens of pairs, and a
// correct pair that fails the gate means a landmark mapped twice.
constexpr double kGate2 = 18.4, kGate3 = 21.1;
constexpr double kMappedByBoth = 0.7;  // Probability that both maps contain a landmark in their common area
constexpr double kLeastArea_m2 = 1.0, kLeastHeights_m = 0.5;

double gate_of(const MapGaussian& a, const MapGaussian& b, const Correspondence& pair) {
  return rows_of_pair(a, b, pair) == 3 ? kGate3 : kGate2;
}

/// Index of the pair that fits the others worst, if it fails the gate; else the number of pairs.
std::size_t worst_pair(const MapGaussian& a, const MapGaussian& b, const JointFit& fit) {
  std::size_t worst = fit.pairs.size();
  double most = 1.0;
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const double share = chi2_of_pair(fit, i) / gate_of(a, b, fit.pairs[i]);
    if (share <= most) continue;
    most = share;
    worst = i;
  }
  return worst;
}

/// The pairs of nearest landmarks that are not in the fit and pass the gate, given the fit.
std::vector<Correspondence> further_pairs(const MapGaussian& a, const MapGaussian& b, const JointFit& fit,
                                          double tolerance_m) {
  std::vector<Correspondence> further;
  const auto is_used = [&](const Correspondence& pair) {
    return std::any_of(fit.pairs.begin(), fit.pairs.end(),
                       [&](const Correspondence& used) { return used.a == pair.a || used.b == pair.b; });
  };
  for (const Correspondence& pair : mutual_pairs(a, b, fit.T_a_b, tolerance_m))
    if (!is_used(pair) && chi2_of_candidate(a, b, fit, pair) <= kGate2) further.push_back(pair);
  return further;
}

/// Number of unpaired landmarks of one map inside the hull of the other.
std::size_t lonely(const MapGaussian& map, const std::vector<bool>& paired, const Pose2& T_other_map,
                   const std::vector<Eigen::Vector2d>& hull_of_other) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.size(); ++i)
    if (!paired[i] && contains(hull_of_other, T_other_map * map.point(i))) ++count;
  return count;
}

double heights_m(const MapGaussian& a, const MapGaussian& b) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const MapGaussian* map : {&a, &b})
    for (const MapLandmark& landmark : map->map->landmarks)
      if (landmark.has_height()) {
        least = std::min(least, landmark.z_map_landmark_m);
        most = std::max(most, landmark.z_map_landmark_m);
      }
  return std::max(kLeastHeights_m, most - least);
}

double diameter_m(const std::vector<Eigen::Vector2d>& hull) {
  double most = 0.0;
  for (const Eigen::Vector2d& p : hull)
    for (const Eigen::Vector2d& q : hull) most = std::max(most, (p - q).norm());
  return most;
}

double log_odds(const MapGaussian& a, const MapGaussian& b, const JointFit& fit) {
  const auto hull_a = hull_of(points_of(a)), hull_b = hull_of(points_of(b));
  const double area_m2 = std::max(kLeastArea_m2, area_of(hull_a)), log_height = std::log(heights_m(a, b));
  std::vector<bool> in_a(a.size(), false), in_b(b.size(), false);
  double odds = fit.log_evidence;
  for (const Correspondence& pair : fit.pairs) {
    in_a[pair.a] = in_b[pair.b] = true;
    const bool named =
        a.landmark(pair.a).identity != kUnknownIdentity && b.landmark(pair.b).identity != kUnknownIdentity;
    odds += std::log(kMappedByBoth) + std::log(named ? area_m2 : area_m2 / static_cast<double>(a.size()));
    if (rows_of_pair(a, b, pair) == 3) odds += log_height;
  }
  const std::size_t missing = lonely(b, in_b, fit.T_a_b, hull_a) + lonely(a, in_a, inverse(fit.T_a_b), hull_b);
  odds += static_cast<double>(missing) * std::log(1.0 - kMappedByBoth);
  const double reach_m = std::max(1.0, diameter_m(hull_a) + diameter_m(hull_b));
  return odds - std::log(2.0 * std::numbers::pi * reach_m * reach_m);
}

}  // namespace

MapOverlap explain(const MapGaussian& a, const MapGaussian& b, const Pose2& start, double tolerance_m) {
  MapOverlap explanation;
  explanation.log_odds = -std::numeric_limits<double>::infinity();
  JointFit& fit = explanation.fit;
  std::vector<Correspondence> pairs = mutual_pairs(a, b, start, tolerance_m);
  for (int turn = 0; turn < kMostExchanges; ++turn) {
    fit = fit_jointly(a, b, pairs, fit.sound ? fit.T_a_b : start);
    if (!fit.sound || pairs.size() < 3) return explanation;
    if (const std::size_t worst = worst_pair(a, b, fit); worst < pairs.size()) {
      pairs.erase(pairs.begin() + as_index(worst));
      continue;
    }
    const std::vector<Correspondence> further = further_pairs(a, b, fit, tolerance_m);
    if (further.empty() || turn + 2 >= kMostExchanges) break;
    pairs.insert(pairs.end(), further.begin(), further.end());
  }
  explanation.log_odds = log_odds(a, b, fit);
  return explanation;
}

}  // namespace azimuth
