#include "slam/map_merge/merge_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "slam/map_merge/joint_fit.hpp"
#include "slam/map_merge/overlap_search.hpp"

namespace azimuth {
namespace {

constexpr double kSureLogOdds = 7.0;  // A thousand to one

/// Whether the maps share a landmark with bit-identical coordinates.
bool same_origin(const MapSnapshot& a, const MapSnapshot& b) {
  return std::any_of(b.landmarks.begin(), b.landmarks.end(), [&](const MapLandmark& other) {
    return std::any_of(a.landmarks.begin(), a.landmarks.end(), [&](const MapLandmark& one) {
      return one.id == other.id && one.p_map_landmark_m == other.p_map_landmark_m;
    });
  });
}

/// One hypothesis about the common landmarks of two maps.
struct MapOverlap {
  JointFit fit;
  double log_odds = 0.0;  ///< Log odds against two maps without common landmarks
};

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

/// Finds the common landmarks near `start`: pairs are removed and added, each judged given all others, until no pair
/// changes. Equation (8) of docs/mathematics.md, VI.30.
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

std::vector<MapOverlap> explanations_of(const MapGaussian& a, const MapGaussian& b) {
  if (a.size() < 3 || b.size() < 3) return {};
  const double tolerance_m = landing_tolerance_m(a, b);
  std::vector<MapOverlap> explanations;
  for (const SuggestedTransform& suggested : suggest_transforms(a, b, tolerance_m)) {
    MapOverlap explanation = explain(a, b, suggested.T_a_b, tolerance_m);
    const bool is_new = std::none_of(explanations.begin(), explanations.end(), [&](const MapOverlap& known) {
      return farthest_m(b, known.fit.T_a_b, explanation.fit.T_a_b) < tolerance_m;
    });
    if (explanation.fit.sound && is_new) explanations.push_back(std::move(explanation));
  }
  std::stable_sort(explanations.begin(), explanations.end(),
                   [](const MapOverlap& one, const MapOverlap& other) { return one.log_odds > other.log_odds; });
  return explanations;
}

/// Marks the unpaired landmarks of b whose identity a landmark of a has.
std::vector<bool> moved_of(const MapGaussian& a, const MapGaussian& b, const JointFit& fit) {
  std::vector<bool> moved(b.size(), false);
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Identity name = b.landmark(k).identity;
    const bool paired = std::any_of(fit.pairs.begin(), fit.pairs.end(), [&](const auto& pair) { return pair.b == k; });
    if (name == kUnknownIdentity || paired) continue;
    moved[k] = std::any_of(a.map->landmarks.begin(), a.map->landmarks.end(),
                           [&](const MapLandmark& landmark) { return landmark.identity == name; });
  }
  return moved;
}

/// The origin of a coordinate of the merged map: a coordinate of a, or of a landmark of b transformed to a's frame.
struct Source {
  bool of_a = true;
  Eigen::Index row = 0;   ///< Row in its map; for a landmark of b, the row of the landmark's x
  Eigen::Index part = 0;  ///< For a landmark of b: 0 for x, 1 for y, 2 for the height
};

/// Map a as corrected by the fit, plus the landmarks that only b has, in a's frame. Landmarks of b marked in `left_out`
/// are dropped. Pose, camera and ids are those of a.
class Merging {
 public:
  Merging(const MapGaussian& a, const MapGaussian& b, const JointFit& fit) : a_(a), b_(b), fit_(fit), merged_(*a.map) {
    merged_.views.clear();
    merged_.landmarks.clear();
    merged_.T_map_body = {fit.mean_a(0), fit.mean_a(1), wrap(fit.mean_a(2))};
    for (std::size_t i = 0; i < merged_.camera.size(); ++i) merged_.camera[i] = fit.mean_a(as_index(3 + i));
    for (Eigen::Index row = 0; row < as_index(a.map->first_landmark_entry()); ++row) sources_.push_back({true, row, 0});
  }

  MapSnapshot run(const std::vector<bool>& left_out) && {
    std::vector<bool> paired(b_.size(), false);
    for (std::size_t i = 0; i < a_.size(); ++i) {
      const auto pair = std::find_if(fit_.pairs.begin(), fit_.pairs.end(), [&](const auto& p) { return p.a == i; });
      if (pair != fit_.pairs.end()) paired[pair->b] = true;
      add_of_a(i, pair == fit_.pairs.end() ? nullptr : &*pair);
    }
    for (std::size_t k = 0; k < b_.size(); ++k)
      if (!paired[k] && !left_out[k]) add_of_b(k);
    set_covariance();
    return std::move(merged_);
  }

 private:
  /// Adds a landmark of a. A height that only b knows is taken from b.
  void add_of_a(std::size_t i, const Correspondence* pair) {
    MapLandmark landmark = a_.landmark(i);
    const Eigen::Index row = a_.row[i];
    landmark.p_map_landmark_m = fit_.mean_a.segment<2>(row);
    sources_.insert(sources_.end(), {{true, row, 0}, {true, row + 1, 0}});
    if (landmark.has_height()) {
      landmark.z_map_landmark_m = fit_.mean_a(row + 2);
      sources_.push_back({true, row + 2, 0});
    }
    if (pair != nullptr) {
      const MapLandmark& other = b_.landmark(pair->b);
      landmark.sightings += other.sightings;
      if (landmark.identity == kUnknownIdentity) landmark.identity = other.identity;
      if (landmark.kind == kAnyKind) landmark.kind = other.kind;
      if (!landmark.has_height() && other.has_height()) add_height(landmark, pair->b);
    }
    merged_.landmarks.push_back(landmark);
  }
  void add_of_b(std::size_t k) {
    MapLandmark landmark = b_.landmark(k);
    const Eigen::Index row = b_.row[k];
    landmark.id = merged_.next_id++;
    landmark.p_map_landmark_m = fit_.T_a_b * Eigen::Vector2d(fit_.mean_b.segment<2>(row));
    sources_.insert(sources_.end(), {{false, row, 0}, {false, row, 1}});
    if (landmark.has_height()) add_height(landmark, k);
    merged_.landmarks.push_back(landmark);
  }
  void add_height(MapLandmark& landmark, std::size_t k) {
    landmark.z_map_landmark_m = fit_.mean_b(b_.row[k] + 2);
    sources_.push_back({false, b_.row[k], 2});
  }

  /// Equation (9) of docs/mathematics.md, VI.30: the derivatives of each coordinate by a, by b and by T, row by row.
  void set_covariance() {
    const Eigen::Index size = as_index(sources_.size()), size_a = a_.mean.size(), size_b = b_.mean.size();
    Eigen::MatrixXd L_a = Eigen::MatrixXd::Zero(size, size_a), L_b = Eigen::MatrixXd::Zero(size, size_b);
    Eigen::MatrixXd L_T = Eigen::MatrixXd::Zero(size, 3);
    for (Eigen::Index i = 0; i < size; ++i) set_row(sources_[as_size(i)], L_a.row(i), L_b.row(i), L_T.row(i));
    const Eigen::MatrixXd LU = L_a * fit_.U_a + L_b * fit_.U_b;
    const Eigen::MatrixXd with_T = -LU * fit_.S_inverse_G * fit_.covariance_T * L_T.transpose();
    const Eigen::MatrixXd covariance = L_a * a_.covariance * L_a.transpose() + L_b * b_.covariance * L_b.transpose() -
                                       LU * fit_.Q * LU.transpose() + with_T + with_T.transpose() +
                                       L_T * fit_.covariance_T * L_T.transpose();
    merged_.covariance.resize(sources_.size());
    for (std::size_t c = 0; c < sources_.size(); ++c)
      for (std::size_t r = c; r < sources_.size(); ++r)
        merged_.covariance(r, c) = 0.5 * (covariance(as_index(r), as_index(c)) + covariance(as_index(c), as_index(r)));
  }
  template <class Row>
  void set_row(const Source& source, Row by_a, Row by_b, Row by_T) const {
    if (source.of_a)
      by_a(source.row) = 1.0;
    else if (source.part == 2)
      by_b(source.row + 2) = 1.0;
    else {
      const Gap at = gap(Eigen::Vector2d::Zero(), fit_.T_a_b, fit_.mean_b.segment<2>(source.row));
      by_b.template segment<2>(source.row) = -at.by_p_b.row(source.part);
      by_T = -at.by_T.row(source.part);
    }
  }

  const MapGaussian &a_, &b_;
  const JointFit& fit_;
  MapSnapshot merged_;
  std::vector<Source> sources_;
};

}  // namespace

MergeRefusal why_not_merged(const MapSnapshot& a, const MapSnapshot& b) {
  if (a.names == MapNames::looks || b.names == MapNames::looks) return MergeRefusal::looks;
  if (a.names != b.names) return MergeRefusal::other_names;
  return same_origin(a, b) ? MergeRefusal::same_origin : MergeRefusal::none;
}

MergedMaps merge_maps(const MapSnapshot& a, const MapSnapshot& b) {
  MergedMaps merged;
  merged.refusal = why_not_merged(a, b);
  if (merged.refusal != MergeRefusal::none) return merged;
  const MapGaussian in_a = gaussian_of(a, Kept::everything), in_b = gaussian_of(b, Kept::landmarks);
  const std::vector<MapOverlap> explanations = explanations_of(in_a, in_b);
  merged.refusal = MergeRefusal::no_overlap;
  if (explanations.empty()) return merged;
  const MapOverlap& best = explanations.front();
  merged.common = best.fit.pairs.size();
  merged.log_odds = best.log_odds;
  if (!(best.log_odds > kSureLogOdds)) return merged;
  merged.refusal = MergeRefusal::several_ways;
  if (explanations.size() > 1 && explanations[1].log_odds > best.log_odds - kSureLogOdds) return merged;
  merged.refusal = MergeRefusal::none;
  merged.T_a_b = best.fit.T_a_b;
  merged.covariance = best.fit.covariance_T;
  merged.chi2 = best.fit.chi2;
  merged.degrees = as_size(best.fit.rows - 3);
  const std::vector<bool> moved = moved_of(in_a, in_b, best.fit);
  merged.moved = as_size(std::count(moved.begin(), moved.end(), true));
  merged.map = Merging(in_a, in_b, best.fit).run(moved);
  merged.added = merged.map.landmarks.size() - a.landmarks.size();
  return merged;
}

}  // namespace azimuth
