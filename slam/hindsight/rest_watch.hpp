#pragma once
#include <optional>

#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Notices that named landmarks are seen to move while odometry stands still: somebody has lifted the robot, or the
/// encoders say nothing. No map is needed for that, and no pose.
///
/// Thread contract: thread-bound.
class RestWatch {
 public:
  /// The robot moved, before the next add().
  void predict(const Motion& motion);
  /// `sigma_rad` is of bearings that say none of their own, `noise` how many times that they turned out to be.
  void add(const BearingSet& image, double sigma_rad, double noise);
  /// Until it has been seen to stand still, or odometry moves.
  bool is_carried() const { return carried_; }

 private:
  double driven_m_ = 0.0, turned_rad_ = 0.0;  ///< since the reference, or since it was known to rest
  std::optional<Stamp> rests_since_;
  std::optional<BearingSet> reference_;
  bool carried_ = false;
};

}  // namespace azimuth
