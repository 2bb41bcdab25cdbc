#include "daemon/publish/path_watch.hpp"

#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

bool has_moved(const Pose2& from, const Pose2& to) {
  return (to.position() - from.position()).norm() > PathWatch::kMoved_m ||
         std::abs(wrap(to.heading_rad - from.heading_rad)) > PathWatch::kTurned_rad;
}

}  // namespace

bool PathWatch::look(std::span<const PathPose> path) {
  bool moved = !any_sent_ && !path.empty();
  std::size_t at = 0;
  for (const PathPose& pose : path) {
    while (at < told_.size() && told_[at].stamp < pose.stamp) ++at;  // the path no longer has this pose
    if (at == told_.size()) {
      told_.push_back(pose);  // AZIMUTH_POSE has published this pose
    } else if (told_[at].stamp == pose.stamp) {
      moved = moved || has_moved(told_[at].T_map_body, pose.T_map_body);
    } else {
      continue;  // a new pose between two published ones
    }
    ++at;
  }
  return moved || at < told_.size();
}

void PathWatch::sent(std::span<const PathPose> path) {
  told_.assign(path.begin(), path.end());
  any_sent_ = true;
}

}  // namespace azimuth
