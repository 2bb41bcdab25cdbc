#include "slam/ekf/resection.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slam/ekf/bearing_model.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kStartsPerSide = 9;
constexpr std::size_t kRefined = 6;  // number of most promising starts
constexpr double kMargin_m = 2.0;    // minimum margin around the landmarks' bounding box
constexpr int kIterations = 20;
constexpr double kSettled = 1e-12;  // a smaller step has converged [m, rad]
// Two solutions nearer than this are the same.
constexpr double kApart_sigmas = 5.0;

/// The heading that fits the directions best at a given position, and the sum of its squared residuals.
struct Start {
  Pose2 pose;
  double cost = std::numeric_limits<double>::infinity();
};

Start start_at(const Eigen::Vector2d& p, std::span<const DirectionTo> directions) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  const auto turn_of = [&](const DirectionTo& direction) {
    const Eigen::Vector2d to = direction.p_map_landmark_m - p;
    return std::atan2(to.y(), to.x()) - direction.azimuth_rad;
  };
  for (const DirectionTo& direction : directions) {
    const double turn_rad = turn_of(direction);
    mean += Eigen::Vector2d(std::cos(turn_rad), std::sin(turn_rad));
  }
  Start start{{p.x(), p.y(), std::atan2(mean.y(), mean.x())}, 0.0};
  for (const DirectionTo& direction : directions) {
    const double residual = wrap(turn_of(direction) - start.pose.heading_rad);
    start.cost += residual * residual;
  }
  return start;
}

/// Starts on a grid over the bounding box of the landmarks and half its size around it, best first.
std::vector<Start> starts(std::span<const DirectionTo> directions) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const DirectionTo& direction : directions) {
    low = low.min(direction.p_map_landmark_m.array());
    high = high.max(direction.p_map_landmark_m.array());
  }
  const Eigen::Array2d margin = (0.5 * (high - low)).max(kMargin_m);
  const Eigen::Array2d step = (high - low + 2.0 * margin) / (kStartsPerSide - 1);
  std::vector<Start> all;
  for (int i = 0; i < kStartsPerSide; ++i)
    for (int j = 0; j < kStartsPerSide; ++j)
      all.push_back(start_at((low - margin + step * Eigen::Array2d(i, j)).matrix(), directions));
  std::sort(all.begin(), all.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
  return all;
}

/// Residuals z - h and Jacobians of all directions at a pose.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixX3d by_pose;
  Eigen::MatrixXd by_landmarks;
};

std::optional<Linearised> linearise(const Pose2& pose, std::span<const DirectionTo> directions, double min_distance_m) {
  const auto n = as_index(directions.size());
  Linearised at{Eigen::VectorXd(n), Eigen::MatrixX3d(n, 3), Eigen::MatrixXd::Zero(n, 2 * n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const DirectionTo& direction = directions[as_size(i)];
    const auto predicted = predict_bearing(pose, direction.p_map_landmark_m, min_distance_m);
    if (!predicted) return std::nullopt;
    at.residuals(i) = wrap(direction.azimuth_rad - predicted->azimuth_rad);
    at.by_pose.row(i) = predicted->by_pose;
    at.by_landmarks.block<1, 2>(i, 2 * i) = predicted->by_landmark;
  }
  return at;
}

/// Gauss-Newton from one start.
std::optional<Resection> refine(Pose2 pose, std::span<const DirectionTo> directions, const Eigen::MatrixXd& P,
                                double variance_rad2, double min_distance_m) {
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const std::optional<Linearised> at = linearise(pose, directions, min_distance_m);
    if (!at) return std::nullopt;
    Eigen::MatrixXd S = at->by_landmarks * P * at->by_landmarks.transpose();
    S.diagonal().array() += variance_rad2;
    const Eigen::LLT<Eigen::MatrixXd> weight(S);
    if (weight.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixX3d weighted = weight.solve(at->by_pose);
    const Eigen::LLT<Eigen::Matrix3d> information(at->by_pose.transpose() * weighted);
    if (information.info() != Eigen::Success) return std::nullopt;
    const Eigen::Matrix3Xd gain = information.solve(weighted.transpose());
    const Eigen::Vector3d step = gain * at->residuals;
    if (step.norm() < kSettled)
      return Resection{pose, information.solve(Eigen::Matrix3d::Identity()), -gain * at->by_landmarks,
                       variance_rad2 * gain * gain.transpose(), at->residuals.dot(weight.solve(at->residuals))};
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), wrap(pose.heading_rad + step.z())};
  }
  return std::nullopt;
}

bool are_apart(const Resection& a, const Resection& b) {
  Eigen::Vector3d difference = a.T_map_body.vector() - b.T_map_body.vector();
  difference.z() = wrap(difference.z());
  return difference.dot(a.covariance.ldlt().solve(difference)) > kApart_sigmas * kApart_sigmas;
}

}  // namespace

std::optional<Resection> resect(std::span<const DirectionTo> directions, const Eigen::MatrixXd& landmark_covariance_m2,
                                double variance_rad2, double min_distance_m) {
  if (directions.size() < 3) return std::nullopt;
  const std::vector<Start> from = starts(directions);
  std::vector<Resection> found;
  for (std::size_t i = 0; i < std::min(kRefined, from.size()); ++i)
    if (auto solution = refine(from[i].pose, directions, landmark_covariance_m2, variance_rad2, min_distance_m))
      found.push_back(*std::move(solution));
  if (found.empty()) return std::nullopt;
  const auto better = [](const Resection& a, const Resection& b) { return a.chi2 < b.chi2; };
  Resection best = *std::min_element(found.begin(), found.end(), better);
  for (const Resection& other : found)
    if (are_apart(best, other)) best.rival_chi2 = std::min(best.rival_chi2, other.chi2);
  return best;
}

}  // namespace azimuth
