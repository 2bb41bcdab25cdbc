#pragma once
// A base that drives along a path and reports it in all supported layouts.

#include <chrono>
#include <cmath>
#include <vector>

#include "drivers/can/can_layout.hpp"
#include "drivers/can/can_odometer.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::test {

inline constexpr double kTrack_m = 0.4;
inline constexpr double kTicksPerM = 10000.0;
inline constexpr CanId kLeftId{0x181, false}, kRightId{0x182, false}, kPoseId{0x183, false}, kRobotId{0x184, false};

inline CanSignal left_ticks(int length_bits) {
  return {kLeftId, {0, length_bits, CanByteOrder::intel}, CanNumber::unsigned_integer};
}
/// In the frame of the left wheel or in a separate frame.
inline CanSignal right_ticks(CanId frame, int length_bits) {
  return {frame, {32, length_bits, CanByteOrder::intel}, CanNumber::unsigned_integer};
}

inline CanLayout ticks_layout(CanId right_frame = kRightId, int length_bits = 32) {
  CanLayout layout;
  layout.odometry = CanOdometryKind::ticks;
  layout.track_m = kTrack_m;
  layout.motion = {{left_ticks(length_bits), 1.0 / kTicksPerM, 3.5},
                   {right_ticks(right_frame, length_bits), 1.0 / kTicksPerM, 3.5}};
  return layout;
}

inline CanLayout speeds_layout() {
  CanLayout layout;
  layout.odometry = CanOdometryKind::speeds;
  layout.track_m = kTrack_m;
  layout.motion = {{{kLeftId, {7, 16, CanByteOrder::motorola}, CanNumber::signed_integer, 0.001}, 1.0, 3.5},
                   {{kLeftId, {23, 16, CanByteOrder::motorola}, CanNumber::signed_integer, 0.001}, 1.0, 3.5}};
  return layout;
}

inline CanLayout pose_layout() {
  CanLayout layout;
  layout.odometry = CanOdometryKind::pose;
  layout.motion = {{{kPoseId, {0, 16, CanByteOrder::intel}, CanNumber::signed_integer, 0.001}, 1.0, 2.2},
                   {{kPoseId, {16, 16, CanByteOrder::intel}, CanNumber::signed_integer, 0.001}, 1.0, 2.2},
                   {{kPoseId, {32, 16, CanByteOrder::intel}, CanNumber::unsigned_integer, 0.01}, kPi / 180.0, 6.3}};
  return layout;
}

inline CanFrame empty_frame(CanId id) {
  CanFrame frame;
  frame.id = id;
  frame.size = 8;
  return frame;
}

/// Writes a counter value, modulo its number of bits.
inline void put_count(const CanSignal& signal, double way_m, CanFrame& frame) {
  const auto count = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(way_m * kTicksPerM)));
  const std::uint64_t mask = signal.bits.length_bits == 64 ? ~0ULL : (1ULL << signal.bits.length_bits) - 1;
  write_bits(signal.bits, count & mask, {frame.data.data(), frame.size});
}

/// A base on exact arcs: wheel paths and pose are functions of time.
class FakeBase {
 public:
  /// Drives on with constant wheel speeds.
  void drive(double left_m_s, double right_m_s, double time_s) {
    left_speed_m_s_ = left_m_s;
    right_speed_m_s_ = right_m_s;
    const double turn_rad = (right_m_s - left_m_s) * time_s / kTrack_m, way_m = 0.5 * (left_m_s + right_m_s) * time_s;
    const double chord_m = turn_rad == 0.0 ? way_m : way_m * std::sin(0.5 * turn_rad) / (0.5 * turn_rad);
    pose_ = pose_ * Pose2{chord_m * std::cos(0.5 * turn_rad), chord_m * std::sin(0.5 * turn_rad), wrap(turn_rad)};
    left_m_ += left_m_s * time_s;
    right_m_ += right_m_s * time_s;
  }
  const Pose2& pose() const { return pose_; }
  /// Resets the counters, as after switching the base off and on; the pose continues.
  void restart() { left_m_ = right_m_ = 0.0; }
  void set_counters(double left_m, double right_m) {
    left_m_ = left_m;
    right_m_ = right_m;
  }

  std::vector<CanFrame> frames(const CanLayout& layout) const {
    std::vector<CanFrame> frames{empty_frame(layout.motion[0].signal.frame)};
    if (layout.motion[1].signal.frame != frames[0].id) frames.push_back(empty_frame(layout.motion[1].signal.frame));
    if (layout.odometry == CanOdometryKind::ticks) {
      put_count(layout.motion[0].signal, left_m_, frames.front());
      put_count(layout.motion[1].signal, right_m_, frames.back());
    } else if (layout.odometry == CanOdometryKind::speeds) {
      encode(layout.motion[0].signal, left_speed_m_s_, frames.front());
      encode(layout.motion[1].signal, right_speed_m_s_, frames.back());
    } else {
      encode(layout.motion[0].signal, pose_.x_m, frames.front());
      encode(layout.motion[1].signal, pose_.y_m, frames.front());
      const double heading_deg = rad_to_degrees(pose_.heading_rad);
      encode(layout.motion[2].signal, heading_deg < 0.0 ? heading_deg + 360.0 : heading_deg, frames.front());
    }
    return frames;
  }

 private:
  double left_m_ = 0.0, right_m_ = 0.0, left_speed_m_s_ = 0.0, right_speed_m_s_ = 0.0;
  Pose2 pose_;
};

}  // namespace azimuth::test
