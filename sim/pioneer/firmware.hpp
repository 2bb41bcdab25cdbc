#pragma once
// The Pioneer's controller as a state machine: bytes and wheel motion in, packets out, in virtual time.

#include <optional>
#include <utility>
#include <vector>

#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/protocol.hpp"
#include "sim/pioneer/model.hpp"
#include "sim/pioneer/motors.hpp"
#include "sim/pioneer/packets.hpp"
#include "sim/pioneer/wheel_counter.hpp"
#include "sim/world/random.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

// The sensors of the controller besides the wheels.

/// The analogue rate gyro: measures the true rotation of the body, coarsely and with noise.
///
/// Thread contract: thread-bound.
class Gyro {
 public:
  explicit Gyro(std::uint64_t seed) : random_(seed, RandomPurpose::gyro) {}

  void turn(double body_turn_rad) { turned_rad_ += body_turn_rad; }
  /// Samples the mean rate since the last sample, `period_s` ago.
  void sample(double period_s);
  /// Discards the rotation and the samples.
  void restart();
  /// The samples since the last call.
  std::vector<GyroSample> take();

 private:
  Random random_;
  double turned_rad_ = 0.0;
  std::vector<GyroSample> samples_;
};

/// The sonar's effect on the line: readings that take up room in SIPs. There are never any echoes.
///
/// Thread contract: thread-bound.
class Sonar {
 public:
  explicit Sonar(const PioneerModel& model) : model_(model) {}

  void switch_on(bool on) { on_ = on; }
  bool on() const { return on_; }
  /// The new readings of one SIP cycle: those whose turn it is, or all.
  std::vector<SonarReading> ping(bool all);

 private:
  PioneerModel model_;
  bool on_ = false;
  int next_ = 0;
};

/// When a kind of packet is sent: never, on a client's request, or always.
enum class Stream { off, on_request, always };

/// The id that standard SIPs carry. Some simulators and firmware always send the same id.
enum class SipId { as_moving, always_stopped, always_moving };

/// Deviations of this controller from a well-behaved one. All may be changed at run time.
struct FirmwareQuirks {
  bool bad_config_checksum = false;  ///< As in real P3DX-SH firmware
  std::optional<int> position_bits;  ///< 15 or 16; nullopt: the model's value
  double start_units = 0.0;          ///< X and y after OPEN, so that an overflow occurs soon
  double start_heading_rad = 0.0;    ///< Heading after OPEN
  std::optional<int> watchdog_ms;    ///< nullopt: the model's value
  bool watchdog_holds_all = false;   ///< The watchdog also stops wheels that no client of this line drives
  bool refuses_host_baud = false;    ///< HOSTBAUD has no effect
  bool resends_sonar = false;        ///< Each SIP holds all sonars, even after the command SONAR 0
  SipId sip_id = SipId::as_moving;
  Stream encoder = Stream::on_request;
  Stream gyro = Stream::on_request;  ///< Except for `always`, the model must have a gyro
  std::uint8_t left_stall_bumpers = 0, right_stall_bumpers = 0;
  bool emergency_stop = false;  ///< The button is pressed; it does not affect wheels that another program drives
};

/// The true instant of a SIP. The x, y and heading in the SIP are those of the wheels at `stamp`.
struct SipLatch {
  Stamp stamp{};
  RawPose pose;
};

/// A client's request: 0 for no packet, 1 for one packet in the next cycle, more for one in each cycle.
class PacketRequest {
 public:
  void ask(int argument) { argument_ = argument; }
  /// Whether a packet must be sent now.
  bool take() { return argument_ > 1 || std::exchange(argument_, 0) == 1; }

 private:
  int argument_ = 0;
};

/// A packet to be sent.
struct Outgoing {
  pioneer::Frame frame;
  int baud = 0;                   ///< Baud rate of the line when the packet was handed over
  std::optional<SipLatch> latch;  ///< Only for standard SIPs
};

/// The protocol of sessions follows that of a real controller (docs/pioneer.md): SYNC0, SYNC1, SYNC2, OPEN; then a SIP
/// each cycle until CLOSE. The numbers 0, 1 and 2 denote synchronisation outside a session, and PULSE, OPEN and CLOSE
/// inside. A client that meets an old session is therefore answered by SIPs. A CLOSE outside a session is not answered;
/// clients send it first.
///
/// Commands that are not simulated only reset the watchdog.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class Firmware {
 public:
  Firmware(const PioneerModel& model, std::uint64_t seed, Stamp now = {});

  FirmwareQuirks quirks;

  /// Bytes from the client, sent at the right baud rate.
  void receive(pioneer::ByteView bytes, Stamp now);
  /// Motion of the wheels since the last call, up to now.
  void roll(const WheelMotion& motion);
  /// Instant of the next advance(); Stamp::max() without a session.
  Stamp due() const { return session_ == Session::open ? next_sample_ : Stamp::max(); }
  void advance(Stamp now);
  /// Returns the packets since the last call, in order.
  std::vector<Outgoing> take_output();

  /// Opens a session without a client, as left by a client that was killed.
  void open(Stamp now);
  /// Simulates a brief power failure: session and odometry are lost. `id` is that of the packet that announces it:
  /// reboot or reboot_with_data.
  void reboot(std::uint8_t id, Stamp now);
  /// Sets the baud rate that an earlier session left.
  void set_baud(int baud) { baud_ = baud; }

  int baud() const { return baud_; }
  bool in_session() const { return session_ == Session::open; }
  /// The motion that a client orders; nullopt if no client drives.
  std::optional<Twist> driven() const { return motors_.driven(); }
  /// Whether the watchdog holds all wheels, including those that other programs drive.
  bool holds_all() const { return quirks.watchdog_holds_all && motors_.held(); }
  const PioneerModel& model() const { return model_; }
  std::uint64_t commands() const { return commands_; }

 private:
  enum class Session { expects_sync0, expects_sync1, expects_sync2, expects_open, open };

  void obey(const pioneer::DecodedCommand& command);
  void synchronise(std::uint8_t number);
  void serve(const pioneer::DecodedCommand& command);
  void stream(pioneer::Command command, int value);
  void drive(pioneer::Command command, int value);
  void limit(pioneer::Command command, int value);
  void drive_wheels(int value);
  void set_outputs(int value);
  void close();
  void set_host_baud(int code);
  Duration sample_period() const { return Duration(std::chrono::milliseconds(model_.sip_cycle_ms)) / kSamplesPerCycle; }
  void send(const pioneer::Frame& frame, std::optional<SipLatch> latch = std::nullopt);
  void send_config();
  void end_cycle();
  void send_gyro();
  void send_sip();
  void send_encoder();
  void send_io();
  bool gyro_streams() const;
  std::uint8_t sip_id(bool moving) const;
  std::uint16_t flags(bool moving) const;

  static constexpr int kSamplesPerCycle = 4;

  PioneerModel model_;
  Gyro gyro_;
  Sonar sonar_;
  Motors motors_;
  WheelCounter wheels_;
  pioneer::PacketScanner scanner_;
  Session session_ = Session::expects_sync0;
  std::vector<Outgoing> output_;
  int baud_;
  Stamp now_, deaf_until_, next_sample_, last_command_;
  int samples_ = 0;  // Number of samples in the current cycle
  PacketRequest encoder_request_, io_request_;
  bool gyro_request_ = false;
  std::uint8_t analog_port_ = 0, digital_out_ = 0;
  std::uint64_t commands_ = 0;
};

}  // namespace azimuth::sim
