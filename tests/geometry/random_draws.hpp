#pragma once
// Seeded random poses, controls and covariances for tests. A failing test repeats with the same draws.

#include <Eigen/Core>
#include <random>

#include "slam/geometry/motion.hpp"

namespace azimuth {

class RandomDraws {
 public:
  explicit RandomDraws(unsigned seed) : generator_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(generator_); }
  double normal(double sigma = 1.0) { return sigma * std::normal_distribution(0.0, 1.0)(generator_); }
  int integer(int low, int high) { return std::uniform_int_distribution(low, high)(generator_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  Eigen::VectorXd normals(Eigen::Index size) {
    return Eigen::VectorXd::NullaryExpr(size, [this](Eigen::Index) { return normal(); });
  }
  /// A pose with any heading, and a position within a square of side 2 `extent_m`.
  Pose2 pose(double extent_m) {
    return {uniform(-extent_m, extent_m), uniform(-extent_m, extent_m), uniform(-kPi, kPi)};
  }
  Eigen::Vector2d point(double extent_m) { return {uniform(-extent_m, extent_m), uniform(-extent_m, extent_m)}; }
  Control control(double max_distance_m, double max_turn_rad) {
    return {uniform(-max_distance_m, max_distance_m), uniform(-max_turn_rad, max_turn_rad),
            uniform(-max_turn_rad, max_turn_rad)};
  }
  /// A positive definite covariance with standard deviations of about `sigma`.
  Eigen::MatrixXd covariance(Eigen::Index size, double sigma) {
    const Eigen::MatrixXd A =
        Eigen::MatrixXd::NullaryExpr(size, size, [this](Eigen::Index, Eigen::Index) { return normal(); });
    return sigma * sigma *
           (A * A.transpose() / static_cast<double>(size) + 0.1 * Eigen::MatrixXd::Identity(size, size));
  }

 private:
  std::mt19937 generator_;
};

}  // namespace azimuth
