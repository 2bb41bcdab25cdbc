#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/ring.hpp"
#include "drivers/can/can_bus.hpp"
#include "drivers/can/can_layout.hpp"
#include "drivers/can/can_link.hpp"
#include "drivers/can/can_odometer.hpp"
#include "drivers/can/can_socket.hpp"
#include "drivers/can/can_state.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/device_news.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Odometry of a base on a CAN bus, for a thread that polls:
///
///   poll descriptor() for POLLIN, for due_in() at most; turn(); take() and take_event() until they say no.
///
/// Listens only. An interface that is unplugged, down or bus-off, and a base that is silent, end nothing: the interface
/// is opened again by its name, ever at most 200 ms after it came, and odometry goes on; that of counters from where
/// they are. Bringing a controller back from bus-off is the kernel's business (ip link set can0 type can restart-ms
/// 100).
///
/// A turn's work is bounded: frames that come faster wait in the kernel, or are dropped there and counted.
///
/// Thread contract: thread-bound; nothing blocks. Nothing allocates while odometry comes.
class CanDriver {
 public:
  using Clock = DeviceClock;

  /// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Opens nothing yet.
  CanDriver(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
            CanLinkOpener open_link = CanSocket::open);

  int descriptor() const { return link_ ? link_->descriptor() : -1; }  ///< -1: none. May change with every turn
  short poll_events() const;
  Clock::duration due_in(Clock::time_point now) const;  ///< until turn() is wanted without any event; never negative

  /// Reads and lets time pass, without blocking.
  void turn(Clock::time_point now);

  /// The oldest reading not taken yet.
  bool take(OdometryReading& reading) { return readings_.pop(reading); }
  /// A sentence for the log about a change, oldest first. Of repeated trouble only the first time is told.
  bool take_event(std::string& event) { return news_.take(event); }

  /// As the Pioneer's driver.
  bool remember(OdometerMemory& out) const;
  void restore(const OdometerMemory& memory);

  const CanState& state() const { return state_; }
  void close();  ///< for good

 private:
  void open(Clock::time_point now);
  void read(Clock::time_point now);
  void receive(const CanReception& reception, Clock::time_point now);
  void read_robot(const CanFrame& frame);
  void read_flag(const std::optional<CanFlagSignal>& flag, const CanFrame& frame, bool& is_set);
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
  CanLink::Counts closed_counts_;  // of links that are no more
  CanBus bus_;
  CanBusState told_bus_ = CanBusState::active;
  Clock::time_point look_at_{}, last_reading_{}, bus_told_at_{};
  BackOff back_off_;
  bool is_new_ = false;   // the link, or it was down: no odometry has come since
  bool is_full_ = false;  // the last turn left frames behind
  std::string told_note_;
  std::uint64_t malformed_robot_ = 0;

  CanState state_;
  std::array<CanReception, kFramesATurn> received_{};
  Ring<OdometryReading, 256> readings_;
  DeviceNews news_;
};

}  // namespace azimuth
