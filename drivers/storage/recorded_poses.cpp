#include "drivers/storage/recorded_poses.hpp"

#include <algorithm>
#include <string>

#include "drivers/storage/each_event.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {

namespace {

RecordedPose recorded_pose(const pose_cov_t& message) {
  RecordedPose pose{.stamp = stamp_from_us(message.utime),
                    .step = message.step,
                    .T_map_body = {message.x_m, message.y_m, message.heading_rad},
                    .covariance = {},
                    .T_odom_body = {message.odom_x_m, message.odom_y_m, message.odom_heading_rad}};
  std::ranges::copy(message.covariance, pose.covariance.begin());
  return pose;
}

}  // namespace

FileResult<std::vector<RecordedPose>> read_recorded_poses(const std::filesystem::path& log_or_session,
                                                          const LogOptions& options) {
  const std::string channel = options.channel_prefix + std::string(channel::kPose);
  std::vector<RecordedPose> poses;
  const FileResult<EventTotals> read = each_event(log_or_session, [&](const LogEvent& event) {
    if (event.channel != channel) return;
    const std::optional<pose_cov_t> message = decode_pose(event.data);
    if (message && message->predicted == 0) poses.push_back(recorded_pose(*message));
  });
  if (!read) return failure(read.error());
  return poses;
}

}  // namespace azimuth
