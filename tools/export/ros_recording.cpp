#include "tools/export/ros_recording.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>

namespace azimuth {
namespace {

constexpr Duration kDiagnosticsEvery = std::chrono::seconds(1);

/// Sends diagnostics at changes of health and at regular intervals.
class Diagnostics {
 public:
  void look(const EstimatedPose& pose, const UseRecorded& use) {
    if (!pose.health) return;
    const bool is_due = said_ == nullptr || pose.stamp - said_->stamp >= kDiagnosticsEvery;
    if (!is_due && said_->health == pose.health && said_->reason == pose.reason) return;
    use(pose.stamp, ros::DiagnosticArray{{pose.stamp, ""}, {ros::health_status(*pose.health, pose.reason)}});
    said_ = &pose;
  }

 private:
  const EstimatedPose* said_ = nullptr;
};

}  // namespace

void record_for_ros(const Estimated& estimated, const UseRecorded& use) {
  assert(!estimated.poses.empty());
  const ros::Frames frames;
  const Stamp begin = estimated.poses.front().stamp;
  use(begin, ros::path_message(frames, begin, path_of(estimated)));
  use(begin, ros::landmark_markers(frames, begin, estimated.landmarks));
  Diagnostics diagnostics;
  std::optional<ros::TimedPose> before;
  for (const EstimatedPose& pose : estimated.poses) {
    use(pose.stamp, ros::pose_message(frames, pose.stamp, pose.T_map_body, pose.covariance));
    if (pose.T_odom_body) {
      const ros::TimedPose now{pose.stamp, *pose.T_odom_body};
      use(pose.stamp, ros::odometry_message(frames, before, now));
      use(pose.stamp, ros::transform_message(frames, pose.stamp, pose.T_map_body, *pose.T_odom_body, true));
      before = now;
    }
    diagnostics.look(pose, use);
  }
}

RecordedSpan recorded_span(const Estimated& estimated) {
  assert(!estimated.poses.empty());
  RecordedSpan span{estimated.poses.front().stamp, estimated.poses.back().stamp};
  for (const PathPose& pose : estimated.path) {
    span.first = std::min(span.first, pose.stamp);
    span.last = std::max(span.last, pose.stamp);
  }
  return span;
}

}  // namespace azimuth
