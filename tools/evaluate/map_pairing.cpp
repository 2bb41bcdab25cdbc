#include "tools/evaluate/map_pairing.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/association/assignment.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();
constexpr double kSigmas = 3.0;

double size_of(std::span<const NamedPoint> world) {
  Eigen::AlignedBox2d box;
  for (const NamedPoint& truth : world)
    if (truth.p_m.allFinite()) box.extend(truth.p_m);
  return box.isEmpty() ? kSmallestMap_m : std::max(kSmallestMap_m, box.diagonal().norm());
}

/// Decides which estimate may belong to which true landmark.
class Gate {
 public:
  Gate(std::span<const NamedPoint> world, const Pose2& T_world_map, MapSpace space)
      : T_world_map_(T_world_map), space_(space), size_m_(size_of(world)) {}

  double farthest_m() const { return kFarthestShare * size_m_; }

  /// Squared distance of the pair; kForbidden if the pair is outside the gate.
  double squared_error_m2(const NamedPoint& estimate, const NamedPoint& truth) const {
    const Eigen::Vector3d error_m = error(estimate, truth);
    const double squared_m2 = error_m.squaredNorm();
    if (!(squared_m2 <= farthest_m() * farthest_m())) return kForbidden;
    const double sigmas2 = error_m.dot(covariance(estimate).inverse() * error_m);
    return sigmas2 <= kSigmas * kSigmas ? squared_m2 : kForbidden;
  }

 private:
  Eigen::Vector3d error(const NamedPoint& estimate, const NamedPoint& truth) const {
    const Eigen::Vector2d flat_m = T_world_map_ * estimate.p_m - truth.p_m;
    return {flat_m.x(), flat_m.y(), space_ == MapSpace::space ? estimate.z_m - truth.z_m : 0.0};
  }

  Eigen::Matrix3d covariance(const NamedPoint& estimate) const {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_world_map_.heading_rad).toRotationMatrix();
    const double bent_m = kBentShare * size_m_ / kSigmas;
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity() * (bent_m * bent_m);
    covariance_m2.topLeftCorner<2, 2>() += R * estimate.covariance_m2 * R.transpose();
    if (space_ == MapSpace::space) covariance_m2(2, 2) += estimate.sigma_z_m * estimate.sigma_z_m;
    return covariance_m2;
  }

  Pose2 T_world_map_;
  MapSpace space_;
  double size_m_;
};

/// Solves the assignment. `squared_m2` has a row for each estimate. An unpaired estimate is a duplicate if a true
/// landmark is within reach, otherwise a phantom.
MapPairing solved(const std::vector<double>& squared_m2, std::size_t rows, std::size_t columns, double alone_m2) {
  MapPairing result;
  if (rows == 0) return result;
  std::vector<int> truth_of;
  Assignment().solve({squared_m2, rows, columns}, std::vector<double>(rows, alone_m2), Objective::minimise, truth_of);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::span<const double> row(squared_m2.data() + i * columns, columns);
    if (truth_of[i] != kUnassigned) {
      result.pairs.push_back({i, as_size(truth_of[i]), std::sqrt(row[as_size(truth_of[i])])});
      continue;
    }
    const bool within_reach = std::ranges::any_of(row, [](double each) { return each < kForbidden; });
    ++(within_reach ? result.duplicates : result.phantoms);
  }
  return result;
}

}  // namespace

MapPairing pair_by_place(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map,
                         MapSpace space) {
  const Gate gate(world, T_world_map, space);
  std::vector<double> squared_m2;
  squared_m2.reserve(map.size() * world.size());
  for (const NamedPoint& estimate : map)
    for (const NamedPoint& truth : world) squared_m2.push_back(gate.squared_error_m2(estimate, truth));
  return solved(squared_m2, map.size(), world.size(), gate.farthest_m() * gate.farthest_m());
}

MapPairing pair_by_name(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map) {
  std::vector<double> squared_m2;
  squared_m2.reserve(map.size() * world.size());
  double largest_m2 = 0.0;
  for (const NamedPoint& estimate : map)
    for (const NamedPoint& truth : world) {
      const double error_m2 = (T_world_map * estimate.p_m - truth.p_m).squaredNorm();
      const bool same = estimate.identity == truth.identity && truth.identity != kUnknownIdentity;
      squared_m2.push_back(same && std::isfinite(error_m2) ? error_m2 : kForbidden);
      if (squared_m2.back() < kForbidden) largest_m2 = std::max(largest_m2, error_m2);
    }
  // The cost of an unpaired estimate is so high that any pair of equal identity is preferred.
  MapPairing result = solved(squared_m2, map.size(), world.size(),
                             2.0 * largest_m2 * static_cast<double>(std::max<std::size_t>(world.size(), 1)) + 1.0);
  result.phantoms = 0;
  return result;
}

}  // namespace azimuth
