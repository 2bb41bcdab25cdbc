#include "tools/check/offset_cost.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

constexpr double kStretch_m = 4.0;

std::vector<double> driven_by(const std::vector<Pose2>& poses) {
  std::vector<double> driven{0.0};
  for (std::size_t i = 1; i < poses.size(); ++i)
    driven.push_back(driven.back() + (poses[i].position() - poses[i - 1].position()).norm());
  return driven;
}

/// Camera poses with the camera's yaw included, so that a motion is expressed in the camera's own axes.
std::vector<Pose2> camera_of(const Drive& drive, const RigGuess& guess, const std::vector<Stamp>& stamps) {
  std::vector<Pose2> poses = camera_at(drive.odometry, guess, stamps);
  for (Pose2& pose : poses) pose.heading_rad = wrap(pose.heading_rad + guess.rig.camera.yaw_offset_rad);
  return poses;
}

Eigen::Vector2d seen_from(const Pose2& start, const Pose2& end) { return (inverse(start) * end).position(); }

/// Mean square of the bearing changes that the found image centre causes.
double turned_rad2(const Drive& drive, const RigGuess& said, const RigGuess& found) {
  if (said.centre_px == found.centre_px) return 0.0;
  RigGuess only = said;
  only.centre_px = found.centre_px;
  double sum = 0.0, count = 0.0;
  for (const BearingSet& set : drive.sets)
    for (const Bearing& bearing : set.bearings) {
      sum += std::pow(wrap(robot_azimuth(bearing, only) - robot_azimuth(bearing, said)), 2);
      ++count;
    }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

OffsetCost offset_cost(const Drive& drive, const RigGuess& said, const RigGuess& found) {
  std::vector<Stamp> stamps;
  for (const BearingSet& set : drive.sets) stamps.push_back(set.stamp);
  const auto by_said = camera_of(drive, said, stamps), by_found = camera_of(drive, found, stamps);
  const std::vector<double> driven = driven_by(by_said);
  OffsetCost cost{.driven_m = std::min(kStretch_m, 0.5 * driven.back())};
  double sum = 0.0, count = 0.0;
  std::size_t end = 0;
  for (std::size_t start = 0; start < stamps.size(); ++start) {
    while (end < stamps.size() && driven[end] < driven[start] + cost.driven_m) ++end;
    if (end == stamps.size()) break;
    sum += (seen_from(by_found[start], by_found[end]) - seen_from(by_said[start], by_said[end])).squaredNorm();
    ++count;
  }
  const double square =
      (count > 0.0 ? sum / count : 0.0) + cost.driven_m * cost.driven_m * turned_rad2(drive, said, found);
  cost.off_m = std::sqrt(square);
  return cost;
}

}  // namespace azimuth
