// The plausibility checks of a map; see map_codec.hpp.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/storage/map_codec.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

// Tolerance for negative eigenvalues of the correlations due to rounding. A filter works with them all the same.
constexpr double kRounding = 1e-6;
constexpr double kMostVariance = 1e12;

bool is_plausible(const MapLandmark& landmark) {
  return landmark.id >= 0 && is_plausible_identity(landmark.identity) && is_plausible_kind(landmark.kind) &&
         is_plausible_coordinate(landmark.p_map_landmark_m.x()) &&
         is_plausible_coordinate(landmark.p_map_landmark_m.y()) &&
         (!landmark.has_height() || is_plausible_coordinate(landmark.z_map_landmark_m));
}

bool repeats(std::vector<std::int64_t>& values) {
  std::ranges::sort(values);
  return std::ranges::adjacent_find(values) != values.end();
}

/// The correlations, which have the same scale for all units. None when the matrix is evidently not a covariance.
std::optional<Eigen::MatrixXd> correlations(const PackedSymmetric& P) {
  const std::size_t size = P.size();
  std::vector<double> scale(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (!(P(i, i) >= 0.0 && P(i, i) <= kMostVariance)) return std::nullopt;
    scale[i] = P(i, i) > 0.0 ? 1.0 / std::sqrt(P(i, i)) : 0.0;
  }
  Eigen::MatrixXd R(size, size);
  for (std::size_t c = 0; c < size; ++c) {
    const auto column = P.below(c);
    for (std::size_t r = c; r < size; ++r) {
      const double correlation = column[r - c] * scale[r] * scale[c];
      const bool certain = scale[r] == 0.0 || scale[c] == 0.0;
      if (!(std::abs(correlation) <= 1.0 + kRounding) || (certain && column[r - c] != 0.0)) return std::nullopt;
      R(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = correlation;
    }
  }
  return R;
}

bool is_covariance(const PackedSymmetric& P) {
  auto R = correlations(P);
  if (!R) return false;
  R->diagonal().array() += kRounding;
  Eigen::Ref<Eigen::MatrixXd> in_place(*R);
  return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(in_place).info() == Eigen::Success;
}

std::optional<std::string> problem_with_views(const MapSnapshot& map) {
  if (map.names != MapNames::looks && !map.views.empty()) return "has looks of landmarks that are not known by them";
  std::vector<std::int64_t> identities;
  for (const MapLandmark& landmark : map.landmarks) identities.push_back(landmark.identity);
  std::ranges::sort(identities);
  for (const MapView& view : map.views) {
    if (!is_plausible_coordinate(view.p_map_robot_m.x()) || !is_plausible_coordinate(view.p_map_robot_m.y()))
      return "has looks from an absurd place";
    if (!std::ranges::binary_search(identities, view.identity)) return "has looks of a landmark it has not";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> implausible(const MapSnapshot& map) {
  if (!is_plausible_stamp(to_us(map.stamp))) return "has an absurd stamp";
  if (!is_plausible(map.T_map_body)) return "has an absurd pose";
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(map.camera, is_finite)) return "has an absurd camera";
  std::vector<std::int64_t> ids;
  for (const MapLandmark& landmark : map.landmarks) {
    if (!is_plausible(landmark)) return "has an absurd landmark";
    if (landmark.id >= map.next_id) return "has a landmark with the number of one to come";
    if (map.names == MapNames::looks && (landmark.identity < 0 || landmark.identity >= map.next_identity))
      return "has a landmark with the name of one to come";
    ids.push_back(landmark.id);
  }
  if (repeats(ids)) return "has two landmarks of one number";
  if (auto problem = problem_with_views(map)) return problem;
  if (map.covariance.size() != map.entries()) return "has a covariance of another size";
  if (!is_covariance(map.covariance)) return "has a covariance that is none";
  return std::nullopt;
}

}  // namespace azimuth
