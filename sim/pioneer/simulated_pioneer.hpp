#pragma once
// A Pioneer at the end of a serial line: controller, line and their faults, in virtual time.

#include <optional>
#include <vector>

#include "sim/pioneer/chassis.hpp"
#include "sim/pioneer/firmware.hpp"
#include "sim/pioneer/wire.hpp"

namespace azimuth::sim {

/// What happened so far, for whoever watches.
struct PioneerCounts {
  std::uint64_t bytes_from_client = 0;
  std::uint64_t bytes_to_client = 0;
  std::uint64_t sips = 0;         ///< put on the line
  std::uint64_t lost_sips = 0;    ///< by the fault
  std::uint64_t crowded_out = 0;  ///< packets for which the line had no time
  std::uint64_t reboots = 0;
  friend bool operator==(const PioneerCounts&, const PioneerCounts&) = default;
};

/// Everything here is a function of the seed and of what the client sends when.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class SimulatedPioneer {
 public:
  /// `chassis` outlives this.
  SimulatedPioneer(const PioneerModel& model, Chassis& chassis, std::uint64_t seed);

  // The client's side of the line.

  /// The rate the client's port is set to; nothing: whatever the robot's is, as behind a bridge.
  void set_client_baud(std::optional<int> baud) { client_baud_ = baud; }
  void client_sends(pioneer::ByteView bytes, Stamp now);
  /// Appends what has reached the client since the last call.
  void take_bytes(Bytes& bytes);
  /// Whether there is a device at all; false while the cable is out.
  bool plugged_in() const { return now_ >= unplugged_until_; }
  /// Whether anything comes from the robot at present.
  bool passes() const { return now_ >= silent_until_ && plugged_in(); }

  // Time.

  /// When advance() is to be called next, at the latest.
  Stamp due() const;
  void advance(Stamp now);

  // Faults; those of the controller itself are firmware().quirks.

  void set_noise(double flip_probability);  ///< per byte, both directions
  void set_lost_bytes(double probability);  ///< per byte, both directions
  void set_lost_sips(double probability) { lose_sips_ = probability; }
  void reboot(std::uint8_t packet_id);
  void silence(Duration duration);  ///< nothing passes either way
  void unplug(Duration duration);
  /// A session is open that its client has left; `baud` is what it had raised the line to.
  void leave_session_open(std::optional<int> baud);

  Chassis& chassis() { return chassis_; }
  Firmware& firmware() { return firmware_; }
  const Firmware& firmware() const { return firmware_; }
  const PioneerCounts& counts() const { return counts_; }
  /// The true instants of the SIPs since the last call.
  std::vector<SipLatch> take_latches();

 private:
  void step(Stamp now);
  void hear();
  void run_firmware();
  void speak();
  void put_on_line(const Outgoing& packet);

  Chassis& chassis_;
  Firmware firmware_;
  Wire to_robot_, to_client_;
  Random random_;
  std::optional<int> client_baud_;
  double lose_sips_ = 0.0;
  Stamp now_{}, silent_until_{}, unplugged_until_{};
  Bytes heard_, spoken_;
  std::vector<SipLatch> latches_;
  PioneerCounts counts_;
};

}  // namespace azimuth::sim
