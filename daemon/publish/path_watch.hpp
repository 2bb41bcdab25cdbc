#pragma once
#include <span>
#include <vector>

#include "slam/estimator/past_pose.hpp"

namespace azimuth {

/// Whether the past has moved so far that somebody who knows the path should be told: who has been sent it once and
/// puts every pose since then behind it.
///
/// Thread contract: thread-bound. Allocates only as the path grows.
class PathWatch {
 public:
  static constexpr double kMoved_m = 0.05, kTurned_rad = 0.02;

  /// The path as it is now, oldest first. True: a pose of it is farther than that from where it was said to be, or its
  /// end is no longer there, or it is the first of all. Poses between may come and go.
  bool look(std::span<const PathPose> path);
  /// That one was sent.
  void sent(std::span<const PathPose> path);

 private:
  std::vector<PathPose> told_;
  bool any_sent_ = false;
};

}  // namespace azimuth
