#pragma once
// Converts the LCM messages of azimuthd to ROS messages.

#include <azimuth/status_t.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/lcm/lcm_sink.hpp"
#include "drivers/ros/messages.hpp"
#include "drivers/wire/messages.hpp"
#include "drivers/wire/pieces.hpp"
#include "tools/ros2/bridge/options.hpp"
#include "tools/ros2/bridge/ros_output.hpp"

namespace azimuth {

/// The counters of received messages since the start.
struct BridgeCounts {
  std::uint64_t poses = 0, maps = 0, paths = 0, statuses = 0;   ///< passed on
  std::map<std::string, std::uint64_t, std::less<>> malformed;  ///< messages that are not of their channel's type
  std::uint64_t beyond_ros = 0;                                 ///< messages with times that ROS 2 cannot represent
  std::uint64_t other_senders = 0;                              ///< messages of a second process on the same channels
  std::uint64_t incomplete = 0;                                 ///< maps and paths with a missing piece
};

/// Takes the messages of one daemon and passes them on. Each pose is sent when it arrives; odometry and transforms are
/// sent for the newest pose; maps and paths when all their pieces have arrived; statuses as diagnostics, with one entry
/// about the bridge itself. While no pose arrives, the diagnostics say so, and one sentence is logged.
///
/// Stamps are the daemon's; diagnostics have the time of arrival of their status.
///
/// Thread contract: thread-bound.
class Bridge : public LcmSink {
 public:
  using Clock = std::chrono::steady_clock;
  using Tell = std::function<void(const std::string& sentence)>;  ///< for a person, in the log

  /// Borrows the output.
  Bridge(BridgeSettings settings, RosOutput& output, Tell tell, Clock::time_point now);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;

  /// Does everything that is due at `now`; `stamp` is the current time on the clock of the receipts. `trouble` tells
  /// why nothing can be received at all; empty: there is no such trouble.
  void turn(Clock::time_point now, Stamp stamp, const std::string& trouble);

  BridgeCounts counts() const;
  /// For a person: "1000 poses, 5 maps, ...; not passed on: ...".
  std::string summary() const;

 private:
  void take(std::string_view channel, Bytes data, const LcmReceipt& receipt);
  void take_pose(const pose_cov_t& pose, const LcmReceipt& receipt);
  void take_status(const status_t& status, const LcmReceipt& receipt);
  void send_motion(Stamp stamp, const Pose2& T_map_body, const Pose2& T_odom_body);
  void tell_of_another_clock(Stamp stamp, Stamp now);
  void tell_of_another_sender();
  bool fits(Stamp stamp);
  std::string why_silent(Clock::time_point now, const std::string& trouble) const;
  ros::DiagnosticStatus own_status(bool silent) const;

  BridgeSettings settings_;
  RosOutput& output_;
  Tell tell_;
  LcmSenderChoice sender_;
  std::optional<Stamp> other_since_;  // since when another sender has been heard beside the current one
  MapPieces map_;
  PathPieces path_;
  BridgeCounts counts_;
  std::optional<ros::TimedPose> odometry_;        // odometry that was sent last
  Clock::time_point heard_;                       // time of the last pose, or of the start
  bool pose_came_ = false, status_came_ = false;  // whether a pose and a status came since the last turn
  std::optional<Clock::time_point> status_heard_;
  std::string devices_;  // text about the devices in the last status
  bool silent_ = false, told_other_sender_ = false, told_beyond_ = false, told_clock_ = false;
  std::optional<Clock::time_point> told_silence_;  // when silence was last reported by diagnostics
};

/// A daemon's status as ROS diagnostics: pose, samples and images, devices, and the process.
std::vector<ros::DiagnosticStatus> diagnostics_of(const status_t& status);

}  // namespace azimuth
