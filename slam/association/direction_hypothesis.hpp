#pragma once
// A joint hypothesis over directions and predictions: some pairings that are believed, and what they say of the others.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/geometry/tangent_direction.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Things predicted by their horizontal offset for each metre of height, m, in the robot's frame.
struct PredictedOffsets {
  std::span<const Eigen::Vector2d> m;
  Eigen::Ref<const Eigen::MatrixXd> covariance;  ///< joint, in blocks of 2 x 2
  std::span<const Identity> identity = {};       ///< of each; empty: nothing has a name
};

/// A direction that may be of something predicted. Both in the plane that touches the unit sphere at the direction.
struct DirectionPair {
  int seen = 0;
  int landmark = 0;
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();  ///< covariance of the innovation
  double distance2 = 0.0;                       ///< innovation^T S^-1 innovation
  double log_likelihood = 0.0;                  ///< ln N(innovation; 0, S)

  /// The last two from innovation and S.
  void judge();
};

/// Pairings that are believed, in the order they were added, with the factor of their joint innovation covariance.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest image.
class DirectionHypothesis {
 public:
  /// No pairing, with room for `most`. `predicted` must live as long as the hypothesis is used.
  void start(const PredictedOffsets& predicted, std::size_t most);

  /// The pair as those believed predict it.
  DirectionPair given(const DirectionPair& pair);
  /// Believes one more. False, and it does not: that would contradict what is believed already to the last bit.
  bool believe(const DirectionPair& pair);

  std::span<const DirectionPair> believed() const { return believed_; }
  double log_likelihood() const { return log_likelihood_; }
  double distance2() const { return distance2_; }

  /// Multiplications made since they were forgotten, by order of magnitude.
  std::uint64_t operations() const { return operations_; }
  void forget_operations() { operations_ = 0; }

 private:
  Eigen::Index rows() const { return 2 * as_index(believed_.size()); }
  void whiten_against_believed(const DirectionPair& pair);

  const PredictedOffsets* predicted_ = nullptr;
  std::vector<DirectionPair> believed_;
  Eigen::MatrixXd L_;         // S = L L^T
  Eigen::MatrixXd across_;    // L^-1 of the covariance with the pair in question, two columns
  Eigen::VectorXd whitened_;  // L^-1 innovation
  double log_likelihood_ = 0.0, distance2_ = 0.0;
  std::uint64_t operations_ = 0;
};

}  // namespace azimuth
