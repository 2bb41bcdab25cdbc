// FastSlam: starting from a map, and saving the map (docs/mathematics.md II.12).

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>

#include "slam/fastslam/fastslam.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

using Index = Eigen::Index;

constexpr std::size_t kFewestForRigid = 3;
constexpr std::uint64_t kMostCounted = std::numeric_limits<std::uint32_t>::max();

/// Derivatives of the landmarks by a rigid motion of the whole map in the plane: translations, and a rotation about its
/// centroid.
Eigen::MatrixX3d by_rigid_motion(const MapSnapshot& map) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const MapLandmark& landmark : map.landmarks)
    middle += landmark.p_map_landmark_m / static_cast<double>(map.landmarks.size());
  Eigen::MatrixX3d J = Eigen::MatrixX3d::Zero(3 * as_index(map.landmarks.size()), 3);
  Index row = 0;
  for (const MapLandmark& landmark : map.landmarks) {
    const Eigen::Vector2d arm = landmark.p_map_landmark_m - middle;
    J.block<2, 3>(row, 0) << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
    row += 3;
  }
  return J;
}

/// Covariance of the landmarks relative to each other, without their common error as a rigid body. The common error
/// does not matter to a robot that localises in the map. A particle takes landmarks as independent, so it would wrongly
/// average a common error out.
Eigen::MatrixXd within_map(const MapSnapshot& map) {
  const Index size = 3 * as_index(map.landmarks.size());
  const std::size_t first = map.first_landmark_entry();
  Eigen::MatrixXd P(size, size);
  for (Index row = 0; row < size; ++row)
    for (Index column = 0; column < size; ++column)
      P(row, column) = map.covariance(first + as_size(row), first + as_size(column));
  if (map.landmarks.size() < kFewestForRigid) return P;
  const Eigen::MatrixX3d J = by_rigid_motion(map);
  const Eigen::MatrixXd others =
      Eigen::MatrixXd::Identity(size, size) - J * (J.transpose() * J).ldlt().solve(Eigen::Matrix3Xd(J.transpose()));
  return others * P * others.transpose();
}

Eigen::Vector3d point_of(const MapLandmark& landmark) {
  return {landmark.p_map_landmark_m.x(), landmark.p_map_landmark_m.y(), landmark.z_map_landmark_m};
}

}  // namespace

void FastSlam::restore(const MapSnapshot& map) {
  assert(step_ < 0 && map.landmarks.size() <= as_size(settings_.max_landmarks));
  const Eigen::MatrixXd P = within_map(map);
  const double floor_m2 = settings_.new_lamp.sigma_floor_m * settings_.new_lamp.sigma_floor_m;
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    particles_[k].T_map_body = map.T_map_body;
    Index at = 0;
    for (const MapLandmark& landmark : map.landmarks) {
      const Symmetric3 covariance = Symmetric3::of(P.block<3, 3>(at, at) + floor_m2 * Eigen::Matrix3d::Identity());
      particles_.add_landmark(k, point_of(landmark), covariance,
                              {.id = landmark.id,
                               .identity = landmark.identity,
                               .counter = settings_.max_counter,
                               .sightings = static_cast<std::uint32_t>(std::min(landmark.sightings, kMostCounted)),
                               .evidence = LampEvidence::certain(),
                               .near = true},
                              covariance);
      at += 3;
    }
  }
  sightings_so_far_ = map.next_id;
  errors_.restore(map);
}

/// Each particle's error is that of the robot plus the drawn offset.
void FastSlam::disperse(const Eigen::Matrix3d& covariance) {
  if (covariance.isZero(0.0)) return;
  const Eigen::Matrix3d L = semidefinite_factor(Symmetric3::of(covariance));
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const double first = random_.normal(), second = random_.normal(), third = random_.normal();
    const Eigen::Vector3d off = L * Eigen::Vector3d(first, second, third);
    particles_[k].T_map_body = particles_[k].T_map_body * Pose2{off.x(), off.y(), off.z()};
  }
  Motion unknown;
  unknown.covariance = covariance;
  errors_.predict(apply(particles_[best_].T_map_body, unknown));
  pending_.covariance += covariance;
}

/// Deletes the candidates, because their detections were made along the path before the move.
void FastSlam::place(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    particles_[k].T_map_body = T_map_body;
    particles_[k].candidates = 0;
    particles_[k].log_weight = 0.0;
  }
  pending_ = {};
  pending_.covariance = covariance;
  errors_.place_pose(Eigen::Matrix3d::Zero());
}

bool FastSlam::save(MapSnapshot& out) const {
  const auto infos = particles_.infos(best_);
  const auto positions = particles_.positions(best_);
  for (std::size_t slot = 0; slot < infos.size(); ++slot) {
    if (!infos[slot].evidence.proven()) continue;
    out.landmarks.push_back({.id = infos[slot].id,
                             .identity = infos[slot].identity,
                             .sightings = infos[slot].sightings,
                             .p_map_landmark_m = positions[slot].head<2>(),
                             .z_map_landmark_m = positions[slot].z()});
  }
  if (out.landmarks.empty()) return false;
  const MovedPose moved = apply(particles_[best_].T_map_body, pending_);
  out.T_map_body = moved.T_map_body;
  out.next_id = sightings_so_far_;
  errors_.save(moved, out);
  return true;
}

}  // namespace azimuth
