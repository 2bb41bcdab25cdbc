#pragma once
// A Pioneer at the end of a serial line: controller, line and faults, in virtual time.

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "drivers/pioneer/packet.hpp"
#include "sim/pioneer/firmware.hpp"
#include "sim/pioneer/motors.hpp"
#include "sim/pioneer/packets.hpp"
#include "sim/pioneer/wheel_counter.hpp"
#include "sim/world/random.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// The robot that carries the controller. It may also be driven without a client of this line, by another program.
class Chassis {
 public:
  virtual ~Chassis() = default;
  /// Motion of wheels and body since the last requested instant. Instants must not decrease.
  virtual WheelMotion roll_to(Stamp until) = 0;
  /// Sets the motion that a client orders; nullopt: no client drives.
  virtual void drive(const std::optional<Twist>& ordered) = 0;
  /// Sets the speed on straights of a robot that no client drives; 0: its own speed.
  virtual void hurry(double speed_m_per_s) = 0;
};

/// Probabilities per byte.
struct WireNoise {
  double flip = 0.0;  ///< Probability that one bit of the byte is flipped
  double lose = 0.0;  ///< Probability that the byte is lost
};

/// One direction of a serial line: bytes take time, and some arrive damaged or are lost. 8N1: a byte takes ten bit
/// times and is received when it is complete.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class Wire {
 public:
  explicit Wire(std::uint64_t seed) : random_(seed, RandomPurpose::line) {}

  WireNoise noise;

  /// Hands bytes to the sender at `now`; they are sent one after the other, after earlier ones.
  void send(pioneer::ByteView bytes, int baud, Stamp now);

  /// Instant at which the next byte is complete; Stamp::max() if there is none.
  Stamp due() const;

  /// Appends what a receiver at `baud` makes of the bytes that are complete by `now`. At another rate than the
  /// sender's, the receiver gets garbage: the higher its rate, the more bytes. Without a rate, the receiver follows the
  /// sender.
  void receive(Stamp now, std::optional<int> baud, Bytes& received);

  std::size_t backlog() const { return bytes_.size(); }

 private:
  using Time = std::chrono::nanoseconds;  // Since the start of virtual time; bit times are not whole microseconds
  struct InFlight {
    std::uint8_t byte;
    int baud;
    Time whole_at;
  };
  void arrive(const InFlight& byte, std::optional<int> baud, Bytes& received);
  void garble(const InFlight& byte, int baud, Bytes& received);

  Random random_;
  std::deque<InFlight> bytes_;
  Time free_at_{};
  double garbage_due_ = 0.0;  // Fraction of a garbage byte in the receiver
};

/// Event counts since the start, for observers.
struct PioneerCounts {
  std::uint64_t bytes_from_client = 0;
  std::uint64_t bytes_to_client = 0;
  std::uint64_t sips = 0;         ///< SIPs sent
  std::uint64_t lost_sips = 0;    ///< SIPs that a fault made the robot lose
  std::uint64_t crowded_out = 0;  ///< Packets for which the line had no time
  std::uint64_t reboots = 0;
  friend bool operator==(const PioneerCounts&, const PioneerCounts&) = default;
};

/// The behaviour is a function of the seed and of what the client sends when.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class SimulatedPioneer {
 public:
  /// `chassis` must outlive this object.
  SimulatedPioneer(const PioneerModel& model, Chassis& chassis, std::uint64_t seed);

  // The client's side of the line.

  /// The baud rate of the client's port; nullopt: always that of the robot, as behind a bridge.
  void set_client_baud(std::optional<int> baud) { client_baud_ = baud; }
  void client_sends(pioneer::ByteView bytes, Stamp now);
  /// Appends the bytes that have reached the client since the last call.
  void take_bytes(Bytes& bytes);
  /// Whether the device exists; false while the cable is unplugged.
  bool plugged_in() const { return now_ >= unplugged_until_; }
  /// Whether bytes pass at present.
  bool passes() const { return now_ >= silent_until_ && plugged_in(); }

  // Time.

  /// The latest instant of the next advance().
  Stamp due() const;
  void advance(Stamp now);

  // Faults; the faults of the controller itself are firmware().quirks.

  void set_noise(double flip_probability);  ///< Per byte, in both directions
  void set_lost_bytes(double probability);  ///< Per byte, in both directions
  void set_lost_sips(double probability) { lose_sips_ = probability; }
  void reboot(std::uint8_t packet_id);
  void silence(Duration duration);  ///< Nothing passes in either direction
  void unplug(Duration duration);
  /// Leaves a session open without a client; `baud` is the rate to which the client had raised the line.
  void leave_session_open(std::optional<int> baud);

  Chassis& chassis() { return chassis_; }
  Firmware& firmware() { return firmware_; }
  const Firmware& firmware() const { return firmware_; }
  const PioneerCounts& counts() const { return counts_; }
  /// Returns the true instants of the SIPs since the last call.
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
