#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/ring.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "drivers/pioneer/device_link.hpp"
#include "drivers/pioneer/odometer.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "drivers/pioneer/session.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// The state of the robot and of the line to it. While the robot is away, the members hold its last values.
struct PioneerState : DeviceState {
  std::string name, subclass, firmware;  ///< as the robot reports
  int baud = 0;                          ///< 0: not a serial line, or not known yet
  bool config_unverified = false;        ///< the robot's CONFIGpac had a wrong checksum and was accepted
  bool uses_ticks = false, uses_gyro = false;

  double battery_V = 0.0;
  struct Charge {
    int percent = -1;  ///< -1: not reported
    /// 0 not charging, 1 bulk, 2 overcharge, 3 float, 4 balance, 255 not reported.
    int state = 255;
  };
  Charge charge;
  bool left_stall = false, right_stall = false;
  struct Bumpers {
    std::uint8_t front = 0, rear = 0;  ///< one bit for each, from bit 0
  };
  Bumpers bumpers;
  bool motors_enabled = false, emergency_stop = false;
  double speed_m_s = 0.0;

  std::uint64_t packets = 0;        ///< correct packets
  std::uint64_t bad_checksums = 0;  ///< wrong checksums, including that of an accepted CONFIGpac
  /// Bytes that belong to no packet, while odometry arrived.
  std::uint64_t skipped_bytes = 0;
  std::uint64_t sessions = 0;          ///< sessions opened so far; all but the first are reconnects or reboots
  std::uint64_t resumed = 0;           ///< how often a session continued after its line had been broken
  std::uint64_t reboots = 0;           ///< reboots of the controller
  std::uint64_t gaps = 0;              ///< readings with more than the usual uncertainty
  std::uint64_t stale = 0;             ///< how often odometry stopped arriving
  std::uint64_t refused_readings = 0;  ///< readings not taken in time
  std::uint64_t reconnects() const { return resumed + (sessions > 0 ? sessions - 1 : 0); }
};

/// Reads the wheel odometry of a Pioneer robot, which is connected by a serial line or by TCP. One thread runs it in a
/// loop. In each round the thread waits with poll(2) until descriptor() has one of poll_events(), or for due_in() at
/// most. Then it calls turn(), and after that take() and take_event() until they return false.
///
/// The driver never moves the robot and never enables its motors. When the robot is unplugged, switched off or silent,
/// the driver opens the device again by its path, which may meanwhile lead to another node. The pauses between attempts
/// grow with the time of absence, up to a second. The odometry then continues; it gets a new origin unless the
/// controller has continued to count. If the robot says that it is of a kind that the driver does not know, the driver
/// asks again after pauses that grow up to 30 s.
///
/// A silent TCP connection is kept beside new attempts, until it is reset or one of them is answered. Some robots never
/// accept a new connection after the client has closed one, but continue with the client they had.
///
/// Thread contract: thread-bound. Only close() blocks. Nothing allocates while the robot's state does not change.
class PioneerDriver {
 public:
  using Clock = pioneer::Clock;

  /// The stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Does not open the device yet. Tests pass another
  /// `open_link`; the name of the device still determines whether there is a baud rate.
  PioneerDriver(const PioneerSettings& settings, Duration epoch_minus_monotonic,
                pioneer::LinkOpener open_link = pioneer::DeviceLink::open);
  ~PioneerDriver();
  PioneerDriver(const PioneerDriver&) = delete;
  PioneerDriver& operator=(const PioneerDriver&) = delete;

  int descriptor() const;     ///< to be polled; -1: none. It may change with every turn.
  short poll_events() const;  ///< events for poll(2)
  /// Time until turn() is needed without any event; never negative.
  Clock::duration due_in(Clock::time_point now) const;

  /// Reads, answers and checks timeouts, without blocking. `now` should be fresh, because it becomes the time of
  /// arrival of the received bytes.
  void turn(Clock::time_point now);

  /// To be called when a device was plugged in: the device is tried at once, and at short intervals for a while, even
  /// after release().
  void wake(Clock::time_point now);
  /// Closes the device, for `at_most` or until wake(). During a reset of its USB port, an open node would come back
  /// under another number.
  void release(Clock::time_point now, Clock::duration at_most);
  /// Time for which the device has been present, or has returned errors of a device that hangs, without sending a byte;
  /// zero while it is away. A robot that is switched off is as silent as a hanging adapter.
  Clock::duration silent_for(Clock::time_point now) const {
    return silent_since_ ? now - *silent_since_ : Clock::duration{};
  }

  /// Writes the state that the next process needs to continue the odometry. False: there is none.
  bool remember(OdometerMemory& out) const;
  /// Called before the first turn(). Readings continue where those of another process ended, if the robot's counters
  /// agree. If they do not, or the memory belongs to another driver, readings start at another origin.
  void restore(const OdometerMemory& memory);

  /// Takes the oldest reading.
  bool take(OdometryReading& reading) { return readings_.pop(reading); }
  /// Takes the oldest message for the log about a change. A repeated trouble is reported only the first time.
  bool take_event(std::string& event) { return news_.take(event); }

  const PioneerState& state() const { return state_; }

  /// Ends the session cleanly, so that the robot's next user finds it ready: sends the closing commands and waits until
  /// they are on the wire, until `deadline` at most. With PioneerSettings::keep_session the session is left open
  /// instead. The driver cannot be used afterwards.
  void close(Clock::time_point deadline);

 private:
  void open(Clock::time_point now);
  void connect(Clock::time_point now);
  void read(Clock::time_point now);
  void take_bytes(pioneer::ByteView bytes, Clock::time_point now);
  void tell_of_telnet();
  void watch_standing(Clock::time_point now);
  void keep_standing(Clock::time_point now);
  void receive(const pioneer::Packet& packet, Clock::time_point now);
  void follow_session();
  void follow_config();
  void look_at(const pioneer::StandardSip& sip, Clock::time_point now);
  void watch_staleness(Clock::time_point now);
  void perform_actions(Clock::time_point now);
  void perform(const pioneer::SessionAction& action, Clock::time_point now);
  void drop_link(const std::string& trouble, Clock::time_point now);
  void give_up(Clock::time_point now);
  void fail_to_open(const pioneer::LinkError& error, Clock::time_point now);
  void update_counters(bool ran);
  void enter(Connection connection, const std::string& trouble) { news_.enter(connection, trouble, state_); }
  pioneer::OdometerSetup odometer_setup() const;
  Clock::duration byte_time() const;

  PioneerSettings settings_;
  Duration epoch_minus_monotonic_;
  pioneer::PacketScanner scanner_;
  pioneer::Session session_;
  pioneer::Odometer odometer_;
  pioneer::LinkOpener open_link_;
  std::unique_ptr<pioneer::Link> link_;
  bool began_ = false;                       // the session has begun on this link
  bool served_ = false;                      // this link has delivered odometry
  std::unique_ptr<pioneer::Link> standing_;  // a silent TCP connection; null: none
  Clock::time_point standing_until_{}, standing_asked_{};

  BackOff back_off_;
  Clock::time_point connect_until_{}, last_sip_{};
  std::optional<Clock::time_point> silent_since_;  // none: the device is away
  // The kind of a robot does not change, but another robot may take its place.
  static constexpr Clock::duration kFirstAfterRefusal = std::chrono::milliseconds(500);
  Clock::duration refusal_back_off_ = kFirstAfterRefusal;
  enum class Followed { opening, no_config, config };
  Followed followed_ = Followed::opening;  // state of the current session that odometer and log know
  std::uint64_t skipped_before_ = 0;
  bool told_telnet_ = false;

  PioneerState state_;
  Ring<OdometryReading, 64> readings_;
  DeviceNews news_;
};

}  // namespace azimuth
