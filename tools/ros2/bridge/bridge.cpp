#include "tools/ros2/bridge/bridge.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <string>
#include <utility>

#include "drivers/estimates/estimate_messages.hpp"
#include "drivers/ros/make_messages.hpp"
#include "drivers/ros/serialize.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

/// After a silence this long another process may take over, such as a restarted daemon.
constexpr Duration kSenderSilence = std::chrono::milliseconds(500);
/// A stamp that is older by more than this comes from a restarted recording, not from a late step.
constexpr Duration kBeganAgain = std::chrono::seconds(1);
/// Two synchronised clocks differ by less than this.
constexpr Duration kSameClock = std::chrono::seconds(10);
constexpr std::chrono::seconds kTellSilenceEvery{1};

bool is_sound(const pose_cov_t& pose) {
  return is_plausible(map_pose_of(pose)) && is_plausible(odom_pose_of(pose)) &&
         std::ranges::all_of(pose.covariance, [](double value) { return std::isfinite(value); });
}

std::vector<LandmarkEstimate> landmarks_of(const std::vector<landmark_t>& messages) {
  std::vector<LandmarkEstimate> landmarks;
  landmarks.reserve(messages.size());
  for (const landmark_t& message : messages) landmarks.push_back(landmark_of(message));
  return landmarks;
}

std::vector<PathPose> path_of_pieces(const std::vector<path_pose_t>& messages) {
  std::vector<PathPose> path;
  path.reserve(messages.size());
  for (const path_pose_t& pose : messages) path.push_back(path_pose_of(pose));
  return path;
}

/// The time of arrival in UTC. The stamp of the receipt advances evenly from the start, so the lead of the wall clock
/// is added.
Stamp arrival(const LcmReceipt& receipt) { return receipt.stamp + receipt.wall_lead; }

using ros::DiagnosticStatus;

DiagnosticStatus named(const char* name) {
  DiagnosticStatus status;
  status.name = std::string("azimuth: ") + name;
  status.hardware_id = "azimuth";
  status.message = "ok";
  return status;
}

void add(DiagnosticStatus& status, const char* key, std::int64_t value) {
  status.values.push_back({key, std::to_string(value)});
}

void add(DiagnosticStatus& status, const char* key, const std::string& value) {
  if (!value.empty()) status.values.push_back({key, value});
}

/// Sets a warning with each sentence that is not empty.
void warn(DiagnosticStatus& status, std::initializer_list<std::string> troubles) {
  for (const std::string& trouble : troubles) {
    if (trouble.empty()) continue;
    status.message = status.level == DiagnosticStatus::kOk ? trouble : status.message + "; " + trouble;
    status.level = DiagnosticStatus::kWarn;
  }
}

DiagnosticStatus pose_of(const status_t& status) {
  DiagnosticStatus pose = ros::health_status(health_of(status.health).value_or(Health::lost), status.reason);
  add(pose, "landmarks", status.landmarks);
  add(pose, "steps", status.steps);
  add(pose, "bearings accepted", status.accepted);
  add(pose, "bearings rejected", status.rejected);
  return pose;
}

DiagnosticStatus input_of(const status_t& status) {
  DiagnosticStatus input = named("input");
  warn(input, {status.input_trouble, status.image_trouble.empty() ? "" : "images: " + status.image_trouble});
  add(input, "images", status.frames);
  add(input, "images of no use", status.frames_unusable);
  add(input, "bearings without odometry", status.bearings_without_odometry);
  add(input, "odometry gaps", status.odometry_gaps);
  add(input, "bearing gaps", status.bearing_gaps);
  return input;
}

DiagnosticStatus devices_of(const status_t& status) {
  DiagnosticStatus devices = named("devices");
  add(devices, "odometer", status.odometer);
  add(devices, "camera", status.camera);
  add(devices, "odometer reconnects", status.odometer_reconnects);
  add(devices, "camera reconnects", status.camera_reconnects);
  add(devices, "images missing", status.camera_missing);
  if (std::isfinite(status.battery_v)) add(devices, "battery [V]", std::to_string(status.battery_v));
  for (const auto& [name, text] : {std::pair{"odometer: ", &status.odometer}, std::pair{"camera: ", &status.camera}})
    if (!text->empty() && !text->starts_with("running")) warn(devices, {name + *text});
  const auto has = [&status](std::int32_t flag) { return (status.robot_flags & flag) != 0; };
  if (has(status_t::ROBOT_EMERGENCY_STOP)) warn(devices, {"emergency stop"});
  if (has(status_t::ROBOT_STALL_LEFT) || has(status_t::ROBOT_STALL_RIGHT)) warn(devices, {"a wheel stalls"});
  if (has(status_t::ROBOT_BUMPER)) warn(devices, {"a bumper is pressed"});
  return devices;
}

DiagnosticStatus process_of(const status_t& status) {
  DiagnosticStatus process = named("process");
  warn(process, {status.configuration, status.map_trouble, status.picture_trouble});
  add(process, "recorder", status.recorder);
  add(process, "realtime", status.realtime);
  add(process, "events not recorded", status.record_losses);
  add(process, "messages not sent", status.publish_failures);
  return process;
}

}  // namespace

Bridge::Bridge(BridgeSettings settings, RosOutput& output, Tell tell, Clock::time_point now)
    : settings_(std::move(settings)), output_(output), tell_(std::move(tell)), sender_(kSenderSilence), heard_(now) {}

void Bridge::accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) {
  std::string_view channel = packet.channel;
  if (!channel.starts_with(settings_.channel_prefix)) return;
  channel.remove_prefix(settings_.channel_prefix.size());
  if (channel != channel::kPose && channel != channel::kMapChunk && channel != channel::kPath &&
      channel != channel::kStatus)
    return;
  if (!sender_.would_accept(sender, receipt.stamp)) {
    ++counts_.other_senders;
    if (!other_since_) other_since_ = receipt.stamp;
    return;
  }
  if (sender_.heard(sender, receipt.stamp))
    other_since_.reset();  // the current sender has restarted
  else if (other_since_)
    tell_of_another_sender();
  take(channel, packet.parts == 1 ? packet.payload : Bytes{}, receipt);  // a daemon's messages are never split
}

void Bridge::take(std::string_view channel, Bytes data, const LcmReceipt& receipt) {
  const auto use = [&](const auto& message, const auto& work) {
    if (message) return work(*message);
    ++counts_.malformed[std::string(channel)];
  };
  if (channel == channel::kPose) use(decode_pose(data), [&](const pose_cov_t& pose) { take_pose(pose, receipt); });
  if (channel == channel::kStatus) use(decode_status(data), [&](const status_t& each) { take_status(each, receipt); });
  if (channel == channel::kMapChunk)
    use(decode_map_chunk(data), [&](const map_chunk_t& piece) {
      if (!map_.take(piece) || !fits(stamp_from_us(map_.utime()))) return;
      output_.send(ros::landmark_markers(settings_.frames, stamp_from_us(map_.utime()), landmarks_of(map_.whole())));
      ++counts_.maps;
    });
  if (channel == channel::kPath)
    use(decode_path(data), [&](const path_t& piece) {
      if (!path_.take(piece) || !fits(stamp_from_us(path_.utime()))) return;
      const std::vector<PathPose> path = path_of_pieces(path_.whole());
      if (!std::ranges::all_of(path, [this](const PathPose& pose) { return fits(pose.stamp); })) return;
      output_.send(ros::path_message(settings_.frames, stamp_from_us(path_.utime()), path));
      ++counts_.paths;
    });
}

void Bridge::take_pose(const pose_cov_t& pose, const LcmReceipt& receipt) {
  if (!is_sound(pose)) return void(++counts_.malformed[std::string(channel::kPose)]);
  const Stamp stamp = stamp_from_us(pose.utime);
  pose_came_ = true;
  if (!fits(stamp)) return;
  tell_of_another_clock(stamp, arrival(receipt));
  output_.send(ros::pose_message(settings_.frames, stamp, map_pose_of(pose), covariance_of(pose)));
  ++counts_.poses;
  send_motion(stamp, map_pose_of(pose), odom_pose_of(pose));
}

/// A step may be older than the prediction sent before it. It then has no new odometry and is skipped.
void Bridge::send_motion(Stamp stamp, const Pose2& T_map_body, const Pose2& T_odom_body) {
  if (odometry_ && stamp <= odometry_->stamp && odometry_->stamp - stamp < kBeganAgain) return;
  const ros::TimedPose now{stamp, T_odom_body};
  output_.send(ros::odometry_message(settings_.frames, odometry_, now));
  if (settings_.transforms != TransformChoice::none)
    output_.send(ros::transform_message(settings_.frames, stamp, T_map_body, T_odom_body,
                                        settings_.transforms == TransformChoice::full));
  odometry_ = now;
}

void Bridge::take_status(const status_t& status, const LcmReceipt& receipt) {
  status_came_ = true;
  devices_ = fmt::format("odometer: {}; camera: {}", status.odometer.empty() ? "none" : status.odometer,
                         status.camera.empty() ? "none" : status.camera);
  ros::DiagnosticArray message{{arrival(receipt), ""}, diagnostics_of(status)};
  if (!fits(message.header.stamp)) return;
  message.status.push_back(own_status(false));
  output_.send(message);
  ++counts_.statuses;
}

/// Counts a stamp that ROS 2 cannot represent, and reports the first one.
bool Bridge::fits(Stamp stamp) {
  if (ros::fits_ros2(stamp)) return true;
  ++counts_.beyond_ros;
  if (!std::exchange(told_beyond_, true))
    tell_(
        fmt::format("a message is stamped {} s since 1970, and ROS 2 counts from 1970 to 2038: such ones are left out",
                    to_us(stamp) / 1'000'000));
  return false;
}

void Bridge::tell_of_another_clock(Stamp stamp, Stamp now) {
  if (std::exchange(told_clock_, true) || std::chrono::abs(now - stamp) <= kSameClock) return;
  tell_(fmt::format(
      "poses are stamped {:.0f} s {} this machine's clock: does azimuthd play a recording, or is a clock wrong? ROS 2 "
      "shows them, but whoever asks for the transform of now gets none",
      std::abs(to_seconds(now - stamp)), stamp < now ? "before" : "after"));
}

void Bridge::tell_of_another_sender() {
  if (std::exchange(told_other_sender_, true)) return;
  tell_(
      "a second process sends on the same channels, and only the first is passed on: give one of the daemons another "
      "daemon.lcm.channel_prefix, and each a bridge with --prefix");
}

void Bridge::turn(Clock::time_point now, Stamp stamp, const std::string& trouble) {
  if (std::exchange(status_came_, false)) status_heard_ = now;
  if (std::exchange(pose_came_, false)) {
    heard_ = now;
    if (std::exchange(silent_, false)) tell_("poses come again");
  }
  if (now - heard_ < settings_.silent_after) return;
  if (!std::exchange(silent_, true)) tell_(why_silent(now, trouble));
  if (told_silence_ && now - *told_silence_ < kTellSilenceEvery) return;
  told_silence_ = now;
  if (fits(stamp)) output_.send(ros::DiagnosticArray{{stamp, ""}, {own_status(true)}});
}

std::string Bridge::why_silent(Clock::time_point now, const std::string& trouble) const {
  const bool is_alive = status_heard_ && now - *status_heard_ < settings_.silent_after;
  if (!trouble.empty()) return "no pose can be heard: " + trouble;
  if (is_alive) return "azimuthd runs, but sends no pose (" + devices_ + ")";
  return fmt::format(
      "no pose on {}{} of {} for {:.0f} s: does azimuthd run, with this daemon.lcm.url and "
      "daemon.lcm.channel_prefix?",
      settings_.channel_prefix, channel::kPose, settings_.lcm_url, std::chrono::duration<double>(now - heard_).count());
}

ros::DiagnosticStatus Bridge::own_status(bool silent) const {
  const BridgeCounts all = counts();
  ros::DiagnosticStatus status;
  status.name = "azimuth: bridge to ROS 2";
  status.hardware_id = "azimuth";
  status.level = silent ? ros::DiagnosticStatus::kStale : ros::DiagnosticStatus::kOk;
  status.message = silent ? "azimuthd sends no pose" : "ok";
  status.values.push_back({"poses", std::to_string(all.poses)});
  for (const auto& [channel, count] : all.malformed)
    status.values.push_back({"malformed " + channel, std::to_string(count)});
  status.values.push_back({"of a second daemon", std::to_string(all.other_senders)});
  status.values.push_back({"of times ROS 2 does not count", std::to_string(all.beyond_ros)});
  status.values.push_back({"incomplete maps and paths", std::to_string(all.incomplete)});
  return status;
}

BridgeCounts Bridge::counts() const {
  BridgeCounts all = counts_;
  all.incomplete = map_.incomplete() + path_.incomplete();
  return all;
}

std::string Bridge::summary() const {
  const BridgeCounts all = counts();
  std::string text =
      fmt::format("{} poses, {} maps, {} paths, {} statuses", all.poses, all.maps, all.paths, all.statuses);
  std::string lost;
  const auto add = [&lost](std::uint64_t count, const std::string& what) {
    if (count > 0) lost += fmt::format("{}{} {}", lost.empty() ? "" : ", ", count, what);
  };
  for (const auto& [channel, count] : all.malformed) add(count, "malformed on " + channel);
  add(all.other_senders, "of a second daemon");
  add(all.beyond_ros, "of times that ROS 2 does not count");
  add(all.incomplete, "maps and paths of which a piece never came");
  return lost.empty() ? text : text + "; not passed on: " + lost;
}

std::vector<DiagnosticStatus> diagnostics_of(const status_t& status) {
  return {pose_of(status), input_of(status), devices_of(status), process_of(status)};
}

}  // namespace azimuth
