#pragma once
#include <span>
#include <vector>

#include "slam/estimator/estimate.hpp"

namespace azimuth {

/// Decides whether the past poses have moved so far that a receiver of the path needs a new one. The receiver got the
/// path once and has appended every pose since then.
///
/// Thread contract: thread-bound. Allocates only when the path grows.
class PathWatch {
 public:
  static constexpr double kMoved_m = 0.05, kTurned_rad = 0.02;

  /// `path` is the current path, oldest pose first. True: a pose is farther than these limits from the pose sent
  /// before, or the end of the sent path is missing, or no path has been sent yet. Poses in between may be added or
  /// removed.
  bool look(std::span<const PathPose> path);
  /// Records that `path` was sent.
  void sent(std::span<const PathPose> path);

 private:
  std::vector<PathPose> told_;
  bool any_sent_ = false;
};

}  // namespace azimuth
