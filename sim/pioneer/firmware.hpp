#pragma once
// The Pioneer's controller as a machine: bytes and wheel motion in, packets out, in virtual time.

#include <optional>
#include <utility>
#include <vector>

#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/protocol.hpp"
#include "sim/pioneer/gyro.hpp"
#include "sim/pioneer/model.hpp"
#include "sim/pioneer/motors.hpp"
#include "sim/pioneer/packets.hpp"
#include "sim/pioneer/sonar.hpp"
#include "sim/pioneer/wheel_counter.hpp"
#include "sim/world/random.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// When a kind of packet streams: never, when a client asked for it, or asked or not.
enum class Stream { off, on_request, always };

/// Which id standard SIPs carry. Some simulators and firmware never tell the truth with it.
enum class SipId { as_moving, always_stopped, always_moving };

/// How this controller differs from a well-behaved one. All may change while it runs.
struct FirmwareQuirks {
  bool bad_config_checksum = false;  ///< as real P3DX-SH firmware
  std::optional<int> position_bits;  ///< 15 or 16; else the model's
  double start_units = 0.0;          ///< x and y right after OPEN, so that a wrap comes soon
  double start_heading_rad = 0.0;    ///< likewise
  std::optional<int> watchdog_ms;    ///< else the model's
  bool watchdog_holds_all = false;   ///< the watchdog also holds wheels that no client of this line drives
  bool refuses_host_baud = false;    ///< HOSTBAUD has no effect
  bool resends_sonar = false;        ///< every sonar in every SIP, whatever SONAR says
  SipId sip_id = SipId::as_moving;
  Stream encoder = Stream::on_request;
  Stream gyro = Stream::on_request;  ///< needs a model with gyro, unless always
  std::uint8_t left_stall_bumpers = 0, right_stall_bumpers = 0;
  bool emergency_stop = false;  ///< the button is pressed; wheels that another program drives do not mind
};

/// The true instant of what a SIP says: its x, y and heading are those of the wheels at `stamp`.
struct SipLatch {
  Stamp stamp{};
  RawPose pose;
};

/// What a client asked for with 0, nothing; 1, one packet with the next cycle; more, one with each.
class PacketRequest {
 public:
  void ask(int argument) { argument_ = argument; }
  /// Whether one is to go out now.
  bool take() { return argument_ > 1 || std::exchange(argument_, 0) == 1; }

 private:
  int argument_ = 0;
};

/// A packet on its way out.
struct Outgoing {
  pioneer::Frame frame;
  int baud = 0;                   ///< of the line when it was handed over
  std::optional<SipLatch> latch;  ///< of a standard SIP
};

/// Sessions as the clients of a real controller expect them (docs/pioneer.md): SYNC0, SYNC1, SYNC2, OPEN; SIPs each
/// cycle until CLOSE. The numbers 0, 1 and 2 mean synchronisation outside a session and PULSE, OPEN, CLOSE inside, so
/// whoever comes upon an old session is answered by SIPs. A CLOSE that finds nothing to end is not answered at all:
/// clients say it before anything else.
///
/// Commands that are not simulated only keep the watchdog quiet.
///
/// Thread contract: thread-bound. Times never decrease from call to call.
class Firmware {
 public:
  Firmware(const PioneerModel& model, std::uint64_t seed, Stamp now = {});

  FirmwareQuirks quirks;

  /// Bytes from the client, at the right baud rate.
  void receive(pioneer::ByteView bytes, Stamp now);
  /// What the wheels did since the last call, up to now.
  void roll(const WheelMotion& motion);
  /// When advance() is to be called next; never, without a session, is Stamp::max().
  Stamp due() const { return session_ == Session::open ? next_sample_ : Stamp::max(); }
  void advance(Stamp now);
  /// The packets since the last call, in order.
  std::vector<Outgoing> take_output();

  /// A session opens without a client, as one that was killed leaves it.
  void open(Stamp now);
  /// Power fails for a moment: session and odometry are gone. `id` is the packet that tells: reboot or
  /// reboot_with_data.
  void reboot(std::uint8_t id, Stamp now);
  /// The baud rate an earlier session left behind.
  void set_baud(int baud) { baud_ = baud; }

  int baud() const { return baud_; }
  bool in_session() const { return session_ == Session::open; }
  /// How a client drives; nothing when none does.
  std::optional<Twist> driven() const { return motors_.driven(); }
  /// The watchdog stops wheels that others drive too.
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
  int samples_ = 0;  // of the present cycle
  PacketRequest encoder_request_, io_request_;
  bool gyro_request_ = false;
  std::uint8_t analog_port_ = 0, digital_out_ = 0;
  std::uint64_t commands_ = 0;
};

}  // namespace azimuth::sim
