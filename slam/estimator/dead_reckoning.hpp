#pragma once
#include <optional>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Whether the pose after `motion`, plus a gap in the odometry with these standard deviations, is so uncertain that a
/// search on the map would find the robot just as soon.
bool is_vague(const Motion& motion, double sigma_gap_m = 0.0, double sigma_gap_rad = 0.0);

/// The motion since a map was saved, by odometry alone, as long as odometry can be trusted. It cannot when the robot is
/// lost, was carried, or its wheels slipped.
///
/// Thread contract: thread-bound; never allocates.
class DeadReckoning {
 public:
  /// Starts from a map saved at the instant `map`, with the robot at `pose`.
  void begin(Stamp map, const PoseBelief& pose);
  void end() { start_.reset(); }
  /// The robot moved by `motion`, and the estimator believes it to be at `now`.
  void add(const Motion& motion, const PoseBelief& now, Health health);

  /// The motion since begin(). Nothing when odometry cannot be trusted any more or the motion is too uncertain to be of
  /// use.
  std::optional<Motion> motion() const;
  Stamp map() const { return map_; }  ///< The instant of the saved map; requires motion()

 private:
  bool explains(const PoseBelief& now) const;

  Stamp map_{};
  std::optional<PoseBelief> start_;
  Motion motion_;
};

}  // namespace azimuth
