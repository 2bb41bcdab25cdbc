#include "tools/evaluate/trajectory.hpp"

#include <algorithm>

namespace azimuth {

std::optional<Pose2> pose_at(std::span<const StampedPose> trajectory, Stamp stamp, double max_gap_s) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [](const StampedPose& sample, Stamp wanted) { return sample.stamp < wanted; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const StampedPose& before = *(after - 1);
  const double gap_s = to_seconds(after->stamp - before.stamp);
  if (gap_s > max_gap_s) return std::nullopt;
  return interpolate(before.pose, after->pose, to_seconds(stamp - before.stamp) / gap_s);
}

}  // namespace azimuth
