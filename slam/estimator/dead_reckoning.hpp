#pragma once
#include <optional>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Whether a search would find the robot as soon: after `motion`, and a gap in it of these standard deviations.
bool is_vague(const Motion& motion, double sigma_gap_m = 0.0, double sigma_gap_rad = 0.0);

/// What odometry alone says of the way since a map was saved, as long as it can be believed: a robot that was lost or
/// carried, or whose wheels slipped, is not where it says.
///
/// Thread contract: thread-bound; never allocates.
class DeadReckoning {
 public:
  /// From a map saved at `map`, with the robot at `pose`.
  void begin(Stamp map, const PoseBelief& pose);
  void end() { start_.reset(); }
  /// The robot moved, and is believed to be at `now`.
  void add(const Motion& motion, const PoseBelief& now, Health health);

  /// The motion since then; nothing: it can no longer be believed, or is too vague to be of use.
  std::optional<Motion> motion() const;
  Stamp map() const { return map_; }  ///< requires motion()

 private:
  bool explains(const PoseBelief& now) const;

  Stamp map_{};
  std::optional<PoseBelief> start_;
  Motion motion_;
};

}  // namespace azimuth
