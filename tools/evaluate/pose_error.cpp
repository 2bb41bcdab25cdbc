#include "tools/evaluate/pose_error.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "slam/geometry/principal_axes.hpp"
#include "slam/geometry/rigid_alignment.hpp"

namespace azimuth {
namespace {

/// Tests the correlation matrix, so that metres and radians need no common scale.
bool invertible(const Eigen::Matrix3d& covariance) {
  constexpr double kSmallestVariance = 1e-14, kSmallestEigenvalue = 1e-9;
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < kSmallestVariance) return false;
  const Eigen::Vector3d scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  return eigenvalues(correlation).minCoeff() > kSmallestEigenvalue;
}

/// The covariance expressed in a frame whose axes are rotated by `heading_rad`.
Eigen::Matrix3d in_turned_frame(const Eigen::Matrix3d& covariance, double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  Eigen::Matrix3d turn;
  turn << c, s, 0, -s, c, 0, 0, 0, 1;
  return turn * covariance * turn.transpose();
}

}  // namespace

std::vector<PosePair> pair_with_truth(std::span<const StampedPose> estimated, std::span<const StampedPose> truth) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < estimated.size(); ++i)
    if (const auto T_world_body = pose_at(truth, estimated[i].stamp))
      pairs.push_back({i, estimated[i].pose, *T_world_body});
  return pairs;
}

std::optional<Pose2> alignment(std::span<const PosePair> pairs) {
  if (pairs.empty()) return std::nullopt;
  std::vector<Eigen::Vector2d> from, to;
  for (const PosePair& pair : pairs) {
    from.push_back(pair.estimated.position());
    to.push_back(pair.T_world_body.position());
  }
  return align(from, to);
}

PoseErrors pose_errors(std::span<const PosePair> pairs, const Pose2& T_world_estimated) {
  PoseErrors errors;
  for (const PosePair& pair : pairs) {
    const Pose2 aligned = T_world_estimated * pair.estimated;
    errors.position_m.push_back((aligned.position() - pair.T_world_body.position()).norm());
    if (std::isfinite(pair.T_world_body.heading_rad))
      errors.heading_rad.push_back(std::abs(wrap(aligned.heading_rad - pair.T_world_body.heading_rad)));
  }
  return errors;
}

std::vector<RelativeError> relative_errors(std::span<const PosePair> pairs, std::span<const EstimateRecord> estimates) {
  std::vector<RelativeError> errors;
  if (pairs.empty() || !std::isfinite(pairs.front().T_world_body.heading_rad)) return errors;
  const Pose2 T_first_map = inverse(pairs.front().estimated);
  const Pose2 T_true_first_world = inverse(pairs.front().T_world_body);
  for (const PosePair& pair : pairs.subspan(1)) {
    RelativeError& relative = errors.emplace_back();
    relative.index = pair.index;
    relative.error = (T_first_map * pair.estimated).vector() - (T_true_first_world * pair.T_world_body).vector();
    relative.error.z() = wrap(relative.error.z());
    relative.covariance = in_turned_frame(estimates[pair.index].covariance, pairs.front().estimated.heading_rad);
  }
  return errors;
}

std::optional<TwoSigmaShare> two_sigma_share(const RelativeError& error) {
  const double kEllipseChi2 = -2.0 * std::log(0.05);  // 95 % quantile of chi squared with two degrees of freedom
  const Eigen::Vector2d off = error.error.head<2>();
  const Eigen::Matrix2d P = error.covariance.topLeftCorner<2, 2>();
  const Eigen::LLT<Eigen::Matrix2d> factor(P);
  if (!P.allFinite() || factor.info() != Eigen::Success) return std::nullopt;
  const double squared_m2 = off.squaredNorm();
  if (squared_m2 == 0.0) return TwoSigmaShare{};
  return TwoSigmaShare{.of_ellipse = std::sqrt(off.dot(factor.solve(off)) / kEllipseChi2),
                       .of_direction = 0.5 * squared_m2 / std::sqrt(off.dot(P * off))};
}

std::optional<double> normalised_squared(const RelativeError& error, const EstimateRecord& estimate) {
  if (!invertible(estimate.covariance)) return std::nullopt;
  return error.error.dot(error.covariance.ldlt().solve(error.error));
}

Consistency consistency(std::span<const PosePair> pairs, std::span<const EstimateRecord> estimates) {
  Consistency result;
  double sum = 0.0;
  for (const RelativeError& relative : relative_errors(pairs, estimates)) {
    const std::optional<double> squared = normalised_squared(relative, estimates[relative.index]);
    ++(squared ? result.evaluated : result.singular);
    sum += squared.value_or(0.0);
  }
  if (result.evaluated > 0) result.anees = sum / static_cast<double>(result.evaluated);
  return result;
}

}  // namespace azimuth
