#include "slam/smoother/keyframe_limit.hpp"

#include <algorithm>
#include <limits>

#include "slam/smoother/keyframe_worth.hpp"

namespace azimuth {
namespace {

// Removing poses orders and factorises everything anew, so many poses are removed at a time.
constexpr int kShareForgotten = 8;                  // one in so many
constexpr int kShareNewest = 4, kShareOldest = 32;  // one in so many is kept

}  // namespace

KeyframeLimit::KeyframeLimit(int max_poses, std::size_t fewest_bearings)
    : max_poses_(max_poses),
      fewest_bearings_(fewest_bearings),
      most_(max_poses > 0 ? max_poses : std::numeric_limits<PoseId>::max()) {}

std::vector<PoseId> KeyframeLimit::least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers) const {
  const int too_many = graph.poses() - max_poses_ + at_a_time();
  const ThinningRule rule{.newest_kept = static_cast<std::size_t>(max_poses_ / kShareNewest),
                          .oldest_kept = static_cast<std::size_t>(max_poses_ / kShareOldest),
                          .fewest_bearings = fewest_bearings_};
  return azimuth::least_worth(graph, numbers, static_cast<std::size_t>(std::max(too_many, 0)), rule);
}

void KeyframeLimit::forgotten(const BearingGraph& graph) { most_ = std::max(max_poses_, graph.poses() + at_a_time()); }

int KeyframeLimit::at_a_time() const { return std::max(1, max_poses_ / kShareForgotten); }

}  // namespace azimuth
