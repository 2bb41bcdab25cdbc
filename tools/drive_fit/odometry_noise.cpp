#include "tools/drive_fit/odometry_noise.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/smoother/factors.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

constexpr int kNoiseRounds = 12;
// Information of the prior on ln(variance). The prior's standard deviation is a factor of three. It keeps the rig's
// ratio between two kinds of noise that explain the drive equally well.
const double kKnownBefore = 1.0 / std::pow(std::log(3.0), 2);
// Initial values if the rig has zero variance.
constexpr std::array<double, kNoiseSorts> kFirst{1e-3, 1e-3, 1e-4, 1e-5};

using Variances = std::array<double, kNoiseSorts>;

OdometryRig rig_of(OdometryRig rig, const Variances& variances) {
  rig.lambda_distance_m = variances[0];
  rig.lambda_rotation_rad = variances[1];
  rig.lambda_drift_rad2_per_m = variances[2];
  rig.sigma_lateral_m_per_sqrt_m = std::sqrt(variances[3]);
  return rig;
}

Variances variances_of(const OdometryRig& rig) {
  return {rig.lambda_distance_m, rig.lambda_rotation_rad, rig.lambda_drift_rad2_per_m,
          rig.sigma_lateral_m_per_sqrt_m * rig.sigma_lateral_m_per_sqrt_m};
}

/// Covariance of each motion for a unit value of one variance. Motion covariances are linear in the variances.
using Unit = std::vector<Eigen::Matrix3d>;

std::array<Unit, kNoiseSorts> units_of(const Drive& drive, const OdometryRig& rig, const std::vector<Stamp>& stamps) {
  std::array<Unit, kNoiseSorts> units;
  for (std::size_t sort = 0; sort < kNoiseSorts; ++sort) {
    Variances only{};
    only[sort] = 1.0;
    for (const DriveMotion& each : motions_between(drive.odometry, rig_of(rig, only), stamps))
      units[sort].push_back(each.motion.covariance);
  }
  return units;
}

/// Posterior covariance of the motion from the previous pose to pose `end`.
Eigen::Matrix3d way_covariance(const Smoother& smoother, PoseId end) {
  const BearingGraph& graph = smoother.graph();
  const SeenMotion seen = see_motion(graph.smoothed_pose(end - 1), graph.smoothed_pose(end));
  const auto along = [&](PoseId id) {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<2, 2>() = rotation(-graph.pose(id).heading_rad);
    return R;
  };
  if (end == 1) {
    const Eigen::Matrix3d J = seen.by_end * along(1);
    return J * smoother.pose_covariance(1) * J.transpose();
  }
  const std::array<Smoother::Unknown, 2> both{Smoother::PoseOf{end - 1}, Smoother::PoseOf{end}};
  Eigen::Matrix<double, 3, 6> J;
  J << seen.by_start * along(end - 1), seen.by_end * along(end);
  return J * smoother.covariance(both) * J.transpose();
}

/// Gradient of the drive's log likelihood by the logarithms of the variances, and its Fisher information.
struct Slope {
  Eigen::Vector4d by = Eigen::Vector4d::Zero();
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
};

Slope slope_of(const Smoother& smoother, const std::array<Unit, kNoiseSorts>& units, const Variances& variances) {
  const BearingGraph& graph = smoother.graph();
  Slope slope;
  for (PoseId id = 1; id < graph.poses(); ++id) {
    const OdometryMeasurement& measured = graph.odometry_to(id);
    const Eigen::Matrix3d Q_inverse = measured.whitening.transpose() * measured.whitening;
    Eigen::Vector3d off = relative_pose(graph.smoothed_pose(id - 1), graph.smoothed_pose(id)) - measured.relative;
    off.z() = wrap(off.z());
    const Eigen::Matrix3d P = way_covariance(smoother, id);
    const Eigen::Matrix3d more = Q_inverse * (off * off.transpose() + P) - Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d told = Eigen::Matrix3d::Identity() - Q_inverse * P;
    std::array<Eigen::Matrix3d, kNoiseSorts> shares;
    for (std::size_t i = 0; i < kNoiseSorts; ++i) {
      const Eigen::Matrix3d share = variances[i] * Q_inverse * units[i][as_size(id)];
      slope.by[as_index(i)] += 0.5 * (more * share).trace();
      shares[i] = told * share;
      for (std::size_t j = 0; j <= i; ++j)
        slope.information(as_index(i), as_index(j)) += 0.5 * (shares[i] * shares[j]).trace();
    }
  }
  slope.information = Eigen::Matrix4d(slope.information.selfadjointView<Eigen::Lower>());
  return slope;
}

void hold(double said, OdometryNoise::Told& noise) {
  const double least = said * std::exp(-2.0 / std::sqrt(kKnownBefore));
  noise.safe_variance = std::max(noise.variance * std::exp(noise.sigma_relative), least);
}

}  // namespace

OdometryNoise odometry_noise(const Drive& drive, const DriveSolution& solution, const HindsightSettings& settings) {
  RigGuess guess = solution.guess;
  DriveGraph graph = solution.graph;
  std::vector<Stamp> stamps;
  for (const DriveGraph::Place& place : graph.places) stamps.push_back(place.stamp);
  const auto units = units_of(drive, guess.rig.odometry, stamps);
  Variances variances = variances_of(guess.rig.odometry);
  for (std::size_t sort = 0; sort < kNoiseSorts; ++sort)
    if (!(variances[sort] > 0.0)) variances[sort] = kFirst[sort];
  const Variances before = variances;
  OdometryNoise noise;
  for (int round = 0; round < kNoiseRounds; ++round) {
    guess.rig.odometry = rig_of(guess.rig.odometry, variances);
    const Smoother smoother = smoother_of(drive, graph, guess, {}, settings);
    graph.values = smoother.graph().values();
    const Slope slope = slope_of(smoother, units, variances);
    const Eigen::Matrix4d known = slope.information + kKnownBefore * Eigen::Matrix4d::Identity();
    Eigen::Vector4d by = slope.by;
    for (std::size_t sort = 0; sort < kNoiseSorts; ++sort)
      by[as_index(sort)] -= kKnownBefore * std::log(variances[sort] / before[sort]);
    const Eigen::Matrix4d covariance = known.inverse();
    const Eigen::Vector4d step = (covariance * by).cwiseMax(-1.0).cwiseMin(1.0);
    for (std::size_t sort = 0; sort < kNoiseSorts; ++sort) {
      variances[sort] *= std::exp(step[as_index(sort)]);
      noise.sorts[sort] = {variances[sort], std::sqrt(covariance(as_index(sort), as_index(sort)))};
    }
  }
  const Variances said = variances_of(solution.guess.rig.odometry);
  for (std::size_t sort = 0; sort < kNoiseSorts; ++sort) hold(said[sort], noise.sorts[sort]);
  return noise;
}

OdometryRig with_noise(const OdometryRig& rig, const OdometryNoise& noise) {
  Variances variances = variances_of(rig);
  for (std::size_t sort = 0; sort < kNoiseSorts; ++sort)
    if (noise.sorts[sort].is_told()) variances[sort] = noise.sorts[sort].safe_variance;
  return rig_of(rig, variances);
}

OdometryRig with_noise_of(const OdometryRig& rig, const OdometryRig& noise) { return rig_of(rig, variances_of(noise)); }

}  // namespace azimuth
