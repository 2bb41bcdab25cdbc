#pragma once
#include <cstdint>
#include <optional>

#include "drivers/device/reading_order.hpp"
#include "drivers/pioneer/measured_motion.hpp"
#include "drivers/pioneer/motion_packets.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "drivers/pioneer/robot_parameters.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth::pioneer {

/// Determines when the controller began to send the packets of a cycle. The controller reads its wheels once per cycle
/// and then sends the packets one after the other, so all packets of a cycle have the same age.
class CycleClock {
 public:
  /// The time at which the cycle of `packet` began on the wire.
  Clock::time_point start_of(const Packet& packet, Clock::duration byte_time) {
    const auto first = packet.first_byte_at;
    const bool goes_on = last_byte_at_ && first - *last_byte_at_ <= kPause && first - start_ <= kLongest;
    if (!goes_on) start_ = first - byte_time;
    const auto following = static_cast<Clock::rep>(packet.data.size() + kFrameOverhead - 1);
    last_byte_at_ = first + byte_time * following;
    return start_;
  }

 private:
  static constexpr Clock::duration kPause = std::chrono::milliseconds(5);
  // Longest time that counts as one cycle, because a fully loaded line has no pauses between cycles.
  static constexpr Clock::duration kLongest = std::chrono::milliseconds(50);
  Clock::time_point start_{};
  std::optional<Clock::time_point> last_byte_at_;
};

/// The data that a session provides for the odometer.
struct OdometerSetup {
  RobotParameters parameters;
  double ticks_per_mm = 0.0;  ///< 0: ENCODERpacs are not used
  bool use_gyro = false;      ///< false also when the firmware corrects the heading by its gyro
  double sip_cycle_s = 0.1;
};

/// Cumulative odometry from the controller's packets.
///
/// Position counters are differenced modulo 2^15 units by the shortest way, which is correct for 15-bit and 16-bit
/// firmware, and headings modulo a turn. So lost packets lose no motion. An implausibly large step is used
/// nevertheless, but marked as uncertain (sigma_gap_m, sigma_gap_rad).
///
/// Wheel ticks, once trusted, replace the counters with their resolution of a millimetre; the analog gyro corrects the
/// turn.
///
/// The stamp of a reading is the time at which its cycle began on the wire. Stamps increase strictly.
///
/// Thread contract: thread-bound; never allocates.
class Odometer {
 public:
  /// `epoch_minus_monotonic` turns times of arrival into stamps.
  Odometer(const PioneerSettings& settings, Duration epoch_minus_monotonic);

  /// The controller restarts its counting: the readings get a new origin, and the motion meanwhile is uncertain.
  void begin_session(const OdometerSetup& setup);
  /// Updates the setup of the same session.
  void refine(const OdometerSetup& setup);

  /// A SIP with its time and pose.
  struct Memory {
    std::uint16_t x_units = 0, y_units = 0;
    std::int16_t heading_units = 0;
    Clock::time_point at{};  ///< when the cycle began
    Pose2 T_odom_body;
    std::uint32_t origin = 0;
  };
  /// The newest SIP; none: there is none in this session.
  std::optional<Memory> memory() const;
  /// Continues the session of another process's odometer. If the first SIP cannot follow the remembered one, the
  /// session is a different one, and the readings start at the next origin.
  void restore(const Memory& memory, const OdometerSetup& setup);

  /// Origins start after `origin`.
  void follow(std::uint32_t origin) { origin_ = origin; }

  /// Takes a message of the session; messages without motion data are ignored. Returns the reading that the message
  /// completes.
  std::optional<OdometryReading> add(const Message& message, Clock::duration byte_time);

  /// Speed over the step of the last reading.
  double speed_m_s() const { return speed_m_s_; }
  bool uses_ticks() const { return ticks_.trusted(); }
  /// Readings with more than the usual uncertainty.
  std::uint64_t gaps() const { return counts_.gaps; }
  /// Turns that only the gyro noticed.
  std::uint64_t skids() const { return counts_.skids; }

 private:
  /// The motion since the last reading, and its uncertainty.
  struct Since {
    Pose2 T_last_body;  // from the SIP alone
    double turn_rad = 0.0, forward_m = 0.0, elapsed_s = 0.0;
    double sigma_m = 0.0, sigma_rad = 0.0;
    int sips = 0;
    bool standing = true;
  };
  /// A SIP and the time at which its cycle began.
  struct Sighting {
    StandardSip sip;
    Clock::time_point at{};
  };
  struct Ticks {
    EncoderPacket packet;
    Clock::time_point at;
  };

  std::optional<OdometryReading> add_sip(const StandardSip& sip, Clock::time_point at);
  std::optional<OdometryReading> add_encoder(const EncoderPacket& packet, Clock::time_point at);
  void step(const Sighting& before, const Sighting& now);
  bool judge(double length_m, double turn_rad, double elapsed_s);
  void add_sigma(double sigma_m, double sigma_rad);
  void bridge_outage(Clock::time_point at);
  bool is_possible(double length_m, double elapsed_s) const;
  bool can_follow(const Sighting& before, const Sighting& now) const;
  bool is_same_cycle(Clock::time_point a, Clock::time_point b) const;
  std::optional<OdometryReading> pair(const EncoderPacket& packet, bool wanted);
  bool ticks_tell_the_way() const;
  OdometryReading emit(const std::optional<TickMotion>& ticks);
  double turn_since_last(const std::optional<TickMotion>& ticks);
  OdometryReading reading();

  /// Largest speed and turn rate of the robot, and the silence after which its motion is uncertain.
  struct Limits {
    double speed_m_s, turn_rad_s, stale_s;
  };
  Limits limits_;
  double ticks_per_turn_;
  Clock::duration usb_latency_;
  Duration epoch_minus_monotonic_;

  OdometerSetup setup_;
  CycleClock cycle_;
  WheelTicks ticks_{0.0, 0.0};
  std::optional<GyroTurn> gyro_;
  std::optional<Sighting> last_;                     // last SIP of this session
  std::optional<Clock::time_point> before_session_;  // last SIP of the previous session
  std::optional<Ticks> unpaired_;
  // The last step, if it was implausible.
  Eigen::Vector2d jump_units_ = Eigen::Vector2d::Zero();
  bool restored_ = false;  // no SIP has arrived since restore()
  bool waits_for_ticks_ = false;
  int sips_without_ticks_ = 0;
  double forward_since_pair_m_ = 0.0;
  Since since_;

  Pose2 T_odom_body_;
  std::uint32_t origin_ = 0;
  struct Counts {
    std::uint64_t gaps = 0, skids = 0;
  };
  Counts counts_;
  ReadingOrder order_;
  double speed_m_s_ = 0.0, turn_rad_s_ = 0.0;
};

}  // namespace azimuth::pioneer
