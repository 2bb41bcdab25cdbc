#include "slam/estimator/dead_reckoning.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kExplainedChi2 = 16.27;            // 99.9 % quantile, three degrees of freedom
constexpr double kSmallest = 1e-6;                  // absorbs rounding [m, rad]
constexpr double kVague_m = 1.0, kVague_rad = 0.3;  // standard deviations

}  // namespace

bool is_vague(const Motion& motion, double sigma_gap_m, double sigma_gap_rad) {
  const Eigen::Vector3d variances = motion.covariance.diagonal();
  return variances.head<2>().maxCoeff() + sigma_gap_m * sigma_gap_m > kVague_m * kVague_m ||
         variances.z() + sigma_gap_rad * sigma_gap_rad > kVague_rad * kVague_rad;
}

void DeadReckoning::begin(Stamp map, const PoseBelief& pose) {
  map_ = map;
  start_ = pose;
  motion_ = {};
}

void DeadReckoning::add(const Motion& motion, const PoseBelief& now, Health health) {
  if (!start_) return;
  append(motion_, motion);
  if (health == Health::lost || !explains(now)) start_.reset();
}

/// Whether the robot is where the motion would put it. `now` includes all bearings since the start, so the uncertainty
/// of `now` is neglected.
bool DeadReckoning::explains(const PoseBelief& now) const {
  const PoseBelief predicted = moved(*start_, motion_);
  Eigen::Vector3d apart = now.T_map_body.vector() - predicted.T_map_body.vector();
  apart.z() = wrap(apart.z());
  const Eigen::Matrix3d covariance = predicted.covariance + kSmallest * kSmallest * Eigen::Matrix3d::Identity();
  return apart.dot(covariance.ldlt().solve(apart)) <= kExplainedChi2;
}

std::optional<Motion> DeadReckoning::motion() const {
  if (!start_ || is_vague(motion_)) return std::nullopt;
  return motion_;
}

}  // namespace azimuth
