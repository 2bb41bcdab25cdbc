#include "tools/export/estimated.hpp"

#include <utility>

#include "drivers/estimates/estimate_messages.hpp"
#include "drivers/storage/recorded_outputs.hpp"

namespace azimuth {
namespace {

EstimatedPose estimated_pose(const RecordedOutput& output) {
  return {.stamp = stamp_from_us(output.pose.utime),
          .T_map_body = map_pose_of(output.pose),
          .covariance = covariance_of(output.pose),
          .T_odom_body = odom_pose_of(output.pose),
          .health = health_of(output.pose.health),
          .reason = output.reason};
}

}  // namespace

Estimated estimated_of(const RecordedOutputs& outputs, std::string run) {
  Estimated estimated{.run = std::move(run), .poses = {}, .path = {}, .landmarks = {}};
  for (const RecordedOutput& output : outputs.poses) estimated.poses.push_back(estimated_pose(output));
  for (const path_pose_t& pose : outputs.path) estimated.path.push_back(path_pose_of(pose));
  for (const landmark_t& landmark : outputs.landmarks) estimated.landmarks.push_back(landmark_of(landmark));
  return estimated;
}

}  // namespace azimuth
