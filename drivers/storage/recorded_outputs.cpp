#include "drivers/storage/recorded_outputs.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drivers/storage/each_event.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "drivers/wire/pieces.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

class OutputReader {
 public:
  explicit OutputReader(RecordedOutputs& out) : out_(out) {}

  void take(std::string_view channel, Bytes data) {
    if (channel == channel::kPose) use(decode_pose(data), [this](const pose_cov_t& pose) { take_pose(pose); });
    if (channel == channel::kMapChunk) use(decode_map_chunk(data), [this](const auto& piece) { map_.take(piece); });
    if (channel == channel::kPath) use(decode_path(data), [this](const auto& piece) { path_.take(piece); });
    if (channel == channel::kStatus) use(decode_status(data), [this](const auto& status) { take_status(status); });
  }
  void finish() {
    out_.landmarks = map_.whole();
    out_.path = path_.whole();
  }

 private:
  template <class Message, class Use>
  void use(const std::optional<Message>& message, const Use& take) {
    if (message) return take(*message);
    ++out_.malformed;
  }
  void take_pose(const pose_cov_t& pose) {
    if (pose.predicted != 0) return;
    if (!is_plausible(Pose2{pose.x_m, pose.y_m, pose.heading_rad})) return void(++out_.malformed);
    if (!out_.poses.empty() && pose.utime <= out_.poses.back().pose.utime) return void(++out_.poses_not_in_order);
    out_.poses.push_back({pose, pose.health == health_ ? reason_ : ""});
  }
  /// Takes a status, which applies to the poses since the previous status as well.
  void take_status(const status_t& status) {
    health_ = status.health;
    reason_ = status.reason;
    for (; told_ < out_.poses.size(); ++told_) {
      RecordedOutput& output = out_.poses[told_];
      if (output.pose.health == health_) output.reason = reason_;
    }
  }

  RecordedOutputs& out_;
  MapPieces map_;
  PathPieces path_;
  std::int8_t health_ = -1;  // health in the last status
  std::string reason_;
  std::size_t told_ = 0;  // number of poses that a status has covered
};

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

FileResult<RecordedOutputs> read_recorded_outputs(const std::filesystem::path& log_or_session,
                                                  const LogOptions& options) {
  RecordedOutputs outputs;
  OutputReader reader(outputs);
  const FileResult<EventTotals> read = each_event(log_or_session, [&](const LogEvent& event) {
    std::string_view channel = event.channel;
    if (!channel.starts_with(options.channel_prefix)) return;
    channel.remove_prefix(options.channel_prefix.size());
    reader.take(channel, event.data);
  });
  if (!read) return failure(read.error());
  reader.finish();
  return outputs;
}

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
