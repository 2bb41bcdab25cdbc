#include "slam/map_merge/merge_maps.hpp"

#include <algorithm>
#include <vector>

#include "slam/map_merge/merged_map.hpp"
#include "slam/map_merge/overlap_odds.hpp"
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
  merged.map = merged_map(in_a, in_b, best.fit, moved);
  merged.added = merged.map.landmarks.size() - a.landmarks.size();
  return merged;
}

}  // namespace azimuth
