#pragma once
#include <cstdint>
#include <optional>

#include "drivers/device/reading_order.hpp"
#include "drivers/pioneer/cycle_clock.hpp"
#include "drivers/pioneer/gyro_turn.hpp"
#include "drivers/pioneer/message.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "drivers/pioneer/robot_parameters.hpp"
#include "drivers/pioneer/wheel_ticks.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth::pioneer {

/// What a session knows about the robot's motion packets.
struct OdometerSetup {
  RobotParameters parameters;
  double ticks_per_mm = 0.0;  ///< 0: no use of ENCODERpacs
  bool use_gyro = false;      ///< false also when firmware corrects the heading with its gyro
  double sip_cycle_s = 0.1;
};

/// Cumulative odometry from the controller's packets.
///
/// Position counters are differenced modulo 2^15 units the shortest way, which is right for 15-bit and 16-bit firmware,
/// and heading modulo a turn, so lost packets lose no motion. A step that is too large to be true is believed all the
/// same, and said to be uncertain (sigma_gap_m, sigma_gap_rad).
///
/// Ticks, once trusted, replace the whole millimetres of the counters; the analog gyro corrects the turn.
///
/// Stamps are those of the cycle's begin on the wire. They increase strictly.
///
/// Thread contract: thread-bound; never allocates.
class Odometer {
 public:
  /// `epoch_minus_monotonic` turns arrival times into stamps.
  Odometer(const PioneerSettings& settings, Duration epoch_minus_monotonic);

  /// The controller begins to count anew: new origin, and what the robot may have moved in between is uncertain.
  void begin_session(const OdometerSetup& setup);
  /// More is known about the same session.
  void refine(const OdometerSetup& setup);

  /// A SIP, and where that was.
  struct Memory {
    std::uint16_t x_units = 0, y_units = 0;
    std::int16_t heading_units = 0;
    Clock::time_point at{};  ///< of the cycle's begin
    Pose2 T_odom_body;
    std::uint32_t origin = 0;
  };
  /// Of the newest SIP; nothing: there is none in this session.
  std::optional<Memory> memory() const;
  /// The session is the one that another process's odometer had. A first SIP that cannot come after what it remembered
  /// is of another one: then all begins anew, at the next origin.
  void restore(const Memory& memory, const OdometerSetup& setup);

  /// Origins begin after that one.
  void follow(std::uint32_t origin) { origin_ = origin; }

  /// A message of the session; others than of motion are ignored. Returns the reading it completes.
  std::optional<OdometryReading> add(const Message& message, Clock::duration byte_time);

  double speed_m_s() const { return speed_m_s_; }  ///< over the last reading's step
  bool uses_ticks() const { return ticks_.trusted(); }
  std::uint64_t gaps() const { return counts_.gaps; }    ///< readings with more than the usual uncertainty
  std::uint64_t skids() const { return counts_.skids; }  ///< turns that only the gyro noticed

 private:
  /// Motion since the last reading, and what is uncertain about it.
  struct Since {
    Pose2 T_last_body;  // by the SIP alone
    double turn_rad = 0.0, forward_m = 0.0, elapsed_s = 0.0;
    double sigma_m = 0.0, sigma_rad = 0.0;
    int sips = 0;
    bool standing = true;
  };
  /// A SIP and when its cycle began.
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

  /// What no robot of this kind exceeds, and for how long it may be silent.
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
  std::optional<Sighting> last_;                     // of this session
  std::optional<Clock::time_point> before_session_;  // last sighting of the session before
  std::optional<Ticks> unpaired_;
  Eigen::Vector2d jump_units_ = Eigen::Vector2d::Zero();  // the last step, if it could not be true
  bool restored_ = false;                                 // and no SIP has come since
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
