#pragma once
// A joint hypothesis over directions and predictions: accepted pairs, and what they imply for other pairs.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/geometry/tangent_direction.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Predicted landmarks, by their horizontal offset per metre of height, m, in the robot's frame.
struct PredictedOffsets {
  std::span<const Eigen::Vector2d> m;
  Eigen::Ref<const Eigen::MatrixXd> covariance;  ///< Joint, in blocks of 2 x 2
  std::span<const Identity> identity = {};       ///< Name of each landmark; empty: no landmark has a name
};

/// A direction paired with a predicted landmark. Innovation and S are in the plane tangent to the unit sphere at the
/// direction.
struct DirectionPair {
  int seen = 0;
  int landmark = 0;
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();  ///< Covariance of the innovation
  double distance2 = 0.0;                       ///< innovation^T S^-1 innovation
  double log_likelihood = 0.0;                  ///< ln N(innovation; 0, S)

  /// Computes distance2 and log_likelihood from innovation and S.
  void judge();
};

/// Accepted pairs, in the order in which they were added, with the Cholesky factor of their joint innovation
/// covariance.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest image.
class DirectionHypothesis {
 public:
  /// Starts without pairs, with room for `most`. `predicted` must outlive the use of the hypothesis.
  void start(const PredictedOffsets& predicted, std::size_t most);

  /// The pair conditioned on the accepted pairs.
  DirectionPair given(const DirectionPair& pair);
  /// Accepts a pair. Returns false, without accepting it, if its conditional covariance is singular.
  bool believe(const DirectionPair& pair);

  std::span<const DirectionPair> believed() const { return believed_; }
  double log_likelihood() const { return log_likelihood_; }
  double distance2() const { return distance2_; }

  /// Estimated number of multiplications since forget_operations().
  std::uint64_t operations() const { return operations_; }
  void forget_operations() { operations_ = 0; }

 private:
  Eigen::Index rows() const { return 2 * as_index(believed_.size()); }
  void whiten_against_believed(const DirectionPair& pair);

  const PredictedOffsets* predicted_ = nullptr;
  std::vector<DirectionPair> believed_;
  Eigen::MatrixXd L_;         // S = L L^T
  Eigen::MatrixXd across_;    // L^-1 times the covariance with the pair under test, two columns
  Eigen::VectorXd whitened_;  // L^-1 innovation
  double log_likelihood_ = 0.0, distance2_ = 0.0;
  std::uint64_t operations_ = 0;
};

}  // namespace azimuth
