#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/ring.hpp"
#include "drivers/can/can_frame.hpp"
#include "drivers/can/can_layout.hpp"
#include "drivers/can/can_link.hpp"
#include "drivers/can/can_odometer.hpp"
#include "drivers/can/can_socket.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// The state of a CAN controller according to its error counters.
enum class CanBusState {
  active,
  warning,  ///< many errors
  passive,  ///< so many errors that the controller no longer signals the errors of other nodes
  off       ///< the controller does not take part in the bus until it is restarted
};

/// The word shown to users, e.g. "error-passive".
const char* text(CanBusState state);

/// The state of the bus as derived from the controller's error frames.
///
/// Thread contract: thread-bound; never allocates.
class CanBus {
 public:
  /// Takes an error frame; other frames are ignored.
  void add(const CanFrame& frame);
  /// To be called when the interface has been opened again.
  void note_opened() { state_ = CanBusState::active; }
  /// To be called when a frame has been received.
  void note_traffic();

  CanBusState state() const { return state_; }
  std::uint64_t error_frames() const { return error_frames_; }
  std::uint64_t bus_offs() const { return bus_offs_; }
  std::uint64_t restarts() const { return restarts_; }  ///< restarts of the controller after bus-off
  /// How often frames were lost because the controller's own buffer was full.
  std::uint64_t overruns() const { return overruns_; }

 private:
  void follow_controller(std::uint8_t details);

  CanBusState state_ = CanBusState::active;
  std::uint64_t error_frames_ = 0, bus_offs_ = 0, restarts_ = 0, overruns_ = 0;
};

/// The state of the base and of its bus. While the base is away, the members hold its last values.
struct CanState : DeviceState {
  CanBusState bus = CanBusState::active;

  double battery_V = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not reported
  bool emergency_stop = false, bumper = false, charging = false;
  double speed_m_s = 0.0;

  std::uint64_t frames = 0;   ///< frames that are read
  std::uint64_t foreign = 0;  ///< other frames that passed the filter
  /// Invalid frames, and frames that are too short for their signals or hold a float that is not a number.
  std::uint64_t malformed = 0;
  std::uint64_t error_frames = 0;      ///< error frames of the controller
  std::uint64_t bus_offs = 0;          ///< how often the controller left the bus
  std::uint64_t dropped = 0;           ///< frames dropped by the kernel or the controller because buffers were full
  std::uint64_t missed = 0;            ///< odometry values that were due and did not arrive
  std::uint64_t doubted = 0;           ///< implausible odometry values
  std::uint64_t restarts = 0;          ///< how often the base restarted its counting
  std::uint64_t gaps = 0;              ///< readings with more than the usual uncertainty
  std::uint64_t stale = 0;             ///< how often odometry stopped arriving
  std::uint64_t stamps_replaced = 0;   ///< implausible receive stamps
  std::uint64_t refused_readings = 0;  ///< readings not taken in time
  /// How often odometry arrived from an interface that was just opened or brought up.
  std::uint64_t sessions = 0;
  std::uint64_t reconnects() const { return sessions > 0 ? sessions - 1 : 0; }
};

/// Odometry of a base on a CAN bus, for a thread that polls:
///
///   poll descriptor() for POLLIN, for due_in() at most; then turn();
///   then take() and take_event() until they return false.
///
/// The driver only listens. When the interface is unplugged, down or bus-off, or the base is silent, the driver opens
/// the interface again by its name, at most 200 ms after its return, and odometry continues. Odometry from counters
/// continues at the counters' values. The kernel brings a controller back from bus-off (ip link set can0 type can
/// restart-ms 100).
///
/// The work of a turn is limited: frames that arrive faster wait in the kernel, or are dropped there and counted.
///
/// Thread contract: thread-bound; nothing blocks. Nothing allocates while odometry arrives.
class CanDriver {
 public:
  using Clock = DeviceClock;

  /// The stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Does not open the interface yet.
  CanDriver(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
            CanLinkOpener open_link = CanSocket::open);

  /// The descriptor to poll; -1: none. It may change with every turn.
  int descriptor() const { return link_ ? link_->descriptor() : -1; }
  short poll_events() const;
  /// Time until turn() is needed without any event; never negative.
  Clock::duration due_in(Clock::time_point now) const;

  /// Reads frames and checks timeouts, without blocking.
  void turn(Clock::time_point now);

  /// Takes the oldest reading.
  bool take(OdometryReading& reading) { return readings_.pop(reading); }
  /// Takes the oldest message for the log about a change. A repeated trouble is reported only the first time.
  bool take_event(std::string& event) { return news_.take(event); }

  /// Writes the state that the next process needs to continue the odometry. False: there is none.
  bool remember(OdometerMemory& out) const;
  void restore(const OdometerMemory& memory);

  const CanState& state() const { return state_; }
  void close();  ///< closes the interface for good

 private:
  void open(Clock::time_point now);
  void read(Clock::time_point now);
  void receive(const CanReception& reception, Clock::time_point now);
  void read_robot(const CanFrame& frame);
  void read_flag(const std::optional<CanSignal>& flag, const CanFrame& frame, bool& is_set);
  bool is_wanted(const CanId& id) const;
  void follow_bus(Clock::time_point now);
  void watch(Clock::time_point now);
  void drop_link(const std::string& trouble, Clock::time_point now);
  void update_counters();
  void enter(Connection connection, const std::string& trouble) { news_.enter(connection, trouble, state_); }

  static constexpr std::size_t kFramesATurn = 256;

  CanSettings settings_;
  CanLayout layout_;
  std::vector<CanId> ids_;
  CanOdometer odometer_;
  CanLinkOpener open_link_;
  std::unique_ptr<CanLink> link_;
  CanLink::Counts closed_counts_;  // counts of closed links
  CanBus bus_;
  CanBusState told_bus_ = CanBusState::active;
  Clock::time_point look_at_{}, last_reading_{}, bus_told_at_{};
  BackOff back_off_;
  // The link is new, or was down; no odometry has come since.
  bool is_new_ = false;
  bool is_full_ = false;  // the last turn left frames unread
  std::string told_note_;
  std::uint64_t malformed_robot_ = 0;

  CanState state_;
  std::array<CanReception, kFramesATurn> received_{};
  Ring<OdometryReading, 256> readings_;
  DeviceNews news_;
};

}  // namespace azimuth
