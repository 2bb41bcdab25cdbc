#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/ring.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/device_news.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "drivers/pioneer/device_link.hpp"
#include "drivers/pioneer/odometer.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "drivers/pioneer/pioneer_state.hpp"
#include "drivers/pioneer/session.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Wheel odometry of a Pioneer, for a thread that polls:
///
///   poll descriptor() for poll_events(), for due_in() at most; turn(); take() and take_event() until they say no.
///
/// Reads only: it never moves the robot nor enables its motors. A robot that is unplugged, switched off or silent ends
/// nothing: the device is opened again (by its path, which may meanwhile lead to another node) with a back-off that
/// grows with the time it is away, to a second at most, and the odometry goes on; from a new origin, unless the
/// controller has counted on. A robot of unknown kind is asked ever more seldom, every 30 s at last.
///
/// A TCP connection that fell silent is kept beside those that are tried, until it is reset or one of them answers:
/// there are robots that never listen there again once they were hung up on, and go on with the client they had.
///
/// Thread contract: thread-bound. Only close() blocks. Nothing allocates while the robot's state does not change.
class PioneerDriver {
 public:
  using Clock = pioneer::Clock;

  /// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Opens nothing yet. `open_link` may lead elsewhere than to
  /// the kernel's devices; the device's name says all the same whether there is a baud rate.
  PioneerDriver(const PioneerSettings& settings, Duration epoch_minus_monotonic,
                pioneer::LinkOpener open_link = pioneer::DeviceLink::open);
  ~PioneerDriver();
  PioneerDriver(const PioneerDriver&) = delete;
  PioneerDriver& operator=(const PioneerDriver&) = delete;

  int descriptor() const;                               ///< -1: none at present. May change with every turn
  short poll_events() const;                            ///< what to poll(2) it for
  Clock::duration due_in(Clock::time_point now) const;  ///< until turn() is wanted without any event; never negative

  /// Reads, answers and lets time pass, without blocking. `now` should be fresh: it dates the bytes that came.
  void turn(Clock::time_point now);

  /// Something was plugged in: the device is tried at once and eagerly for a while, also after release().
  void wake(Clock::time_point now);
  /// Lets go of the device, for `at_most` or until wake(): while its USB port is reset, a node that is held open would
  /// come back under another number.
  void release(Clock::time_point now, Clock::duration at_most);
  /// How long the device has been there, or answered that it does not work, without a byte coming from it; zero while
  /// it is away. A robot that is switched off is as silent as an adapter that hangs.
  Clock::duration silent_for(Clock::time_point now) const {
    return silent_since_ ? now - *silent_since_ : Clock::duration{};
  }

  /// What the next process needs to go on with the odometry; false: there is nothing to go on with.
  bool remember(OdometerMemory& out) const;
  /// Before the first turn(): readings go on where those of another process ended, if the robot's counters do. If they
  /// do not, or another driver remembered this, readings begin at another origin than those.
  void restore(const OdometerMemory& memory);

  /// The oldest reading not taken yet.
  bool take(OdometryReading& reading) { return readings_.pop(reading); }
  /// A sentence for the log about a change, oldest first. Of repeated trouble only the first time is told.
  bool take_event(std::string& event) { return news_.take(event); }

  const PioneerState& state() const { return state_; }

  /// Ends the session cleanly, so that the robot's next user finds it ready: sends what ends it and waits until that is
  /// on the wire, until `deadline` at most. Unless the settings say that the next user goes on with it. For good.
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
  bool began_ = false;                       // the session, on this link
  bool served_ = false;                      // odometry came over this link since it was the one
  std::unique_ptr<pioneer::Link> standing_;  // that fell silent; null: none did
  Clock::time_point standing_until_{}, standing_asked_{};

  BackOff back_off_;
  Clock::time_point connect_until_{}, last_sip_{};
  std::optional<Clock::time_point> silent_since_;  // none: the device is away
  // A robot does not change its kind, but another may take its place.
  static constexpr Clock::duration kFirstAfterRefusal = std::chrono::milliseconds(500);
  Clock::duration refusal_back_off_ = kFirstAfterRefusal;
  enum class Followed { opening, no_config, config };
  Followed followed_ = Followed::opening;  // how far the present session was
  std::uint64_t skipped_before_ = 0;
  bool told_telnet_ = false;

  PioneerState state_;
  Ring<OdometryReading, 64> readings_;
  DeviceNews news_;
};

}  // namespace azimuth
