#pragma once
// The interface every estimator has: a filter today, a smoother tomorrow. Nothing outside may assume which.

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/motion.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Turns motion and bearings into poses and a map.
///
/// Thread contract: thread-bound (one thread at a time may use one object). No call allocates once the map has
/// stopped growing. Same calls, same bits.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// The robot moved: advance to the instant at the end of `motion`.
  virtual void predict(const Motion& motion) = 0;

  /// Uses the bearings of the instant that predict() advanced to.
  virtual void update(const BearingSet& observations) = 0;

  /// Writes pose, covariance, landmarks, health and association counts of the present instant into `out`,
  /// reusing its storage. Leaves stamps, sequence numbers and input counts to the caller.
  virtual void estimate(Estimate& out) const = 0;

  /// Pose and covariance (and nothing else) after a further `motion`, without advancing to it.
  virtual void look_ahead(const Motion& motion, Pose2& T_map_body, Eigen::Matrix3d& covariance) const = 0;
};

}  // namespace azimuth
