#include "tests/support/hidden_lab.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "tools/evaluate/trajectory.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

// The block lies inside the path of coloured_lab(), which runs 2 m from the walls.
const Rectangle kBlock{{4.5, 4.0}, {9.5, 6.0}};

/// The length of the segment from `a` to `b` that lies within the rectangle.
double length_within(const Rectangle& rectangle, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double from = 0.0, to = 1.0;
  const Eigen::Vector2d way = b - a;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0.0) {
      if (a[axis] < rectangle.low_m[axis] || a[axis] > rectangle.high_m[axis]) return 0.0;
      continue;
    }
    const double low = (rectangle.low_m[axis] - a[axis]) / way[axis];
    const double high = (rectangle.high_m[axis] - a[axis]) / way[axis];
    from = std::max(from, std::min(low, high));
    to = std::min(to, std::max(low, high));
  }
  return std::max(0.0, to - from) * way.norm();
}

/// Depth of `p` below the nearest side of the rectangle; 0 outside it. Allows a landmark on the block itself to be
/// seen.
double depth_within(const Rectangle& rectangle, const Eigen::Vector2d& p) {
  return std::max(0.0, std::min((p - rectangle.low_m).minCoeff(), (rectangle.high_m - p).minCoeff()));
}

}  // namespace

void hide_behind(const Rectangle& block, Run& run) {
  constexpr double kSideways = 1.5;  // allows a view at an angle to the side
  std::vector<StampedPose> truth;
  for (const TruthPose& pose : run.truth) truth.push_back({pose.stamp, pose.T_world_body});
  for (BearingSet& set : run.bearings) {
    const std::optional<Pose2> T_world_body = pose_at(truth, set.stamp);
    std::erase_if(set.bearings, [&](const Bearing& bearing) {
      const auto landmark = std::find_if(run.landmarks.begin(), run.landmarks.end(),
                                         [&](const TrueLandmark& l) { return l.identity == bearing.identity; });
      if (landmark == run.landmarks.end() || !T_world_body) return true;
      const Eigen::Vector2d p(landmark->x_m, landmark->y_m);
      return length_within(block, T_world_body->position(), p) > kSideways * depth_within(block, p);
    });
  }
}

Run hidden_lab(std::uint64_t seed, int laps) {
  Run run = simulated_run(coloured_lab(seed, laps));
  run.name = "hidden-lab-" + std::to_string(seed);
  hide_behind(kBlock, run);
  return run;
}

}  // namespace azimuth
