#pragma once
// What azimuthd sends over LCM, as messages of ROS.

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/lcm/lcm_sink.hpp"
#include "drivers/wire/messages.hpp"
#include "drivers/wire/pieces.hpp"
#include "ros2/bridge/bridge_settings.hpp"
#include "ros2/bridge/ros_output.hpp"

namespace azimuth {

/// What became of what was heard, since the start.
struct BridgeCounts {
  std::uint64_t poses = 0, maps = 0, paths = 0, statuses = 0;   ///< passed on
  std::map<std::string, std::uint64_t, std::less<>> malformed;  ///< messages that are none of their channel's type
  std::uint64_t beyond_ros = 0;                                 ///< of times that ROS 2 does not count
  std::uint64_t other_senders = 0;                              ///< of a second process that sends on the same channels
  std::uint64_t incomplete = 0;                                 ///< maps and paths of which a piece never came
};

/// Takes the messages of one daemon and hands them on: each pose as it comes; odometry and transforms of the newest
/// ones; maps and paths when all their pieces are there; statuses as diagnostics, with a word on the bridge itself.
/// While no pose comes, it says so there, and once in a sentence.
///
/// Stamps are the daemon's; diagnostics have the time at which their status arrived.
///
/// Thread contract: thread-bound.
class Bridge : public LcmSink {
 public:
  using Clock = std::chrono::steady_clock;
  using Tell = std::function<void(const std::string& sentence)>;  ///< for a person, in the log

  /// Borrows the output.
  Bridge(BridgeSettings settings, RosOutput& output, Tell tell, Clock::time_point now);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;

  /// What is due by now, `stamp` being the time on the clock of the receipts. `trouble` is why nothing can be heard at
  /// all; empty: nothing is.
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
  std::optional<Stamp> other_since_;  // heard beside the present one
  MapPieces map_;
  PathPieces path_;
  BridgeCounts counts_;
  std::optional<ros::TimedPose> odometry_;        // sent last
  Clock::time_point heard_;                       // a pose, or the start
  bool pose_came_ = false, status_came_ = false;  // since the last turn
  std::optional<Clock::time_point> status_heard_;
  std::string devices_;  // as the last status tells of them
  bool silent_ = false, told_other_sender_ = false, told_beyond_ = false, told_clock_ = false;
  std::optional<Clock::time_point> told_silence_;  // by diagnostics
};

}  // namespace azimuth
