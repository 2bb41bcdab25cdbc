#pragma once
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Notices that landmarks are seen to move while odometry stands still: somebody has lifted the robot, or the encoders
/// say nothing. No map is needed for that, and no pose. Without names a landmark has moved when nothing was seen where
/// it is seen now.
///
/// Thread contract: thread-bound.
class RestWatch {
 public:
  explicit RestWatch(bool named) : named_(named) {}

  /// The robot moved, before the next add().
  void predict(const Motion& motion);
  /// `sigma_rad` is of bearings that say none of their own, `noise` how many times that they turned out to be.
  void add(const BearingSet& image, double sigma_rad, double noise);
  /// Until it has been seen to stand still, or odometry moves.
  bool is_carried() const { return carried_; }

 private:
  bool is_at_rest(Stamp stamp);
  /// The one that has been seen at rest and may be this one; null: none.
  const Bearing* seen_before(const Bearing& bearing) const;

  bool named_;
  double driven_m_ = 0.0, turned_rad_ = 0.0;  ///< since the reference, or since it was known to rest
  std::optional<Stamp> rests_since_;
  /// What was seen at rest: the bearings of its first images, that one of them may have missed some.
  std::vector<Bearing> reference_;
  int images_ = 0;  ///< that these are of
  Stamp seen_{};    ///< the last of them
  bool carried_ = false;
};

}  // namespace azimuth
