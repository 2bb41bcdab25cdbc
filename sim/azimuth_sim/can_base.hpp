#pragma once
// The robot's base as a node on a CAN bus, in virtual time.

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "base/unique_fd.hpp"
#include "drivers/can/can_frame.hpp"
#include "sim/pioneer/wheel_counter.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Sends frames to a CAN interface. Frames that the interface does not accept are lost, as on a bus. If the interface
/// disappears, the sender tries from time to time to open it again by its name.
///
/// Thread contract: thread-bound; never blocks.
class CanSender {
 public:
  explicit CanSender(std::string interface) : interface_(std::move(interface)) {}

  FileResult<void> open();
  void send(std::span<const CanFrame> frames);
  std::uint64_t lost() const { return lost_; }
  const std::string& interface() const { return interface_; }

 private:
  bool send_one(const CanFrame& frame);

  std::string interface_;
  UniqueFd fd_;
  std::chrono::steady_clock::time_point retry_at_{};
  std::uint64_t lost_ = 0;
};

inline constexpr Duration kCanCycle = std::chrono::milliseconds(20);

/// The state that the base reports in each cycle.
struct CanBaseReport {
  WheelMotion rolled;  ///< Motion of the wheels since the start
  bool emergency_stop = false, bumper = false;
  double battery_v = 0.0;
};

/// Makes the CAN frames that config/simulated-can.dbc describes.
///
/// Thread contract: thread-bound.
class CanBase {
 public:
  /// Appends the frames of the next cycle.
  void report(const CanBaseReport& report, std::vector<CanFrame>& frames);
  /// Restarts the base: its counters begin at zero again.
  void restart(const WheelMotion& rolled);

 private:
  double left_zero_m_ = kStart_m, right_zero_m_ = kStart_m;
  std::uint64_t cycles_ = 0;

  // The counters start two metres before their overflow, so that it occurs soon.
  static constexpr double kStart_m = 2.0 - 8388608.0 / 20000.0;
};

/// Human-readable description of the frames: ids, bytes, units and rates.
std::string can_base_help();

}  // namespace azimuth::sim
