#pragma once
// A Pioneer controller for the driver's tests: it works on bytes, without time and without a line.

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/motion_packets.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/protocol.hpp"
#include "tests/drivers/pioneer/stream.hpp"

namespace azimuth::pioneer::test {

class FakeController {
 public:
  FakeController() {
    config.robot_class = "Pioneer";
    config.subclass = "p3dx-sh";
    config.serial_number = "TEST_0001";
    config.top = {.rotation_deg_per_s = 360,
                  .velocity_mm_per_s = 1000,
                  .rotation_acceleration_deg_per_s2 = 300,
                  .acceleration_mm_per_s2 = 2000};
    config.pwm_max = 500;
    config.name = "Tester";
    config.ticks_per_mm = 128;
    config.firmware_version = "2.9";
  }

  // Properties, to be set before use.
  ConfigPacket config;
  bool config_checksum_is_wrong = false, answers_config = true, follows_host_baud = true;
  bool answers_nothing = false;  // receives everything, but neither answers nor obeys
  int start_baud = 9600;

  // State.
  StandardSip sip;
  EncoderPacket ticks;
  int baud = 9600;
  bool open = false, sends_encoder = false, sends_gyro = false;
  std::vector<ByteVector> commands;  // all commands received so far

  /// Processes bytes that the client sends at `line_baud`. At another rate than the controller's they are noise.
  ByteVector receive(ByteView bytes, int line_baud) {
    ByteVector answer;
    if (line_baud != 0 && line_baud != baud) return answer;
    while (!bytes.empty()) {
      bytes = bytes.subspan(scanner_.add(bytes, {}));
      while (const auto packet = scanner_.next()) obey(packet->data, answer);
    }
    return answer;
  }

  /// The bytes that the controller sends in one cycle.
  ByteVector cycle() const {
    ByteVector bytes;
    if (!open || answers_nothing) return bytes;
    if (sends_encoder) append(bytes, encode_encoder(ticks).view());
    append(bytes, encode_sip(sip).view());
    return bytes;
  }

  /// Switches the controller off and on.
  void restart() {
    open = sends_encoder = sends_gyro = false;
    baud = start_baud;
    sync_ = 0;
    sip = {};
    ticks = {};
  }

 private:
  void obey(ByteView data, ByteVector& answer) {
    commands.push_back(to_vector(data));
    if (answers_nothing) return;
    if (!open) return synchronise(data, answer);
    const DecodedCommand command = decode_command(data);
    if (command.is(Command::close)) return end();
    if (command.is(Command::encoder)) sends_encoder = command.value != 0;
    if (command.is(Command::gyro)) sends_gyro = command.value != 0;
    if (command.is(Command::config) && answers_config) answer_config(answer);
    if (command.is(Command::host_baud) && follows_host_baud) baud = *baud_of_code(*command.value);
  }

  /// OPEN and SYNC1 have the same number; the preceding commands distinguish them.
  void synchronise(ByteView data, ByteVector& answer) {
    const std::uint8_t number = data.front();
    if (sync_ == 3 && number == 1) return begin();
    if (number > 2) return;
    if (number == 0) sync_ = 0;
    if (number != sync_) return append(answer, encode_frame(ByteVector{0xFF}).view());
    ByteVector echo{number};
    if (number == 2) {
      for (const auto& text : {config.name, config.robot_class, config.subclass}) {
        echo.insert(echo.end(), text.begin(), text.end());
        echo.push_back(0);
      }
    }
    append(answer, encode_frame(echo).view());
    ++sync_;
  }

  void begin() {
    open = true;
    sip.x_units = sip.y_units = 0;
    sip.heading_units = 0;
  }

  void end() {
    open = sends_encoder = sends_gyro = false;
    sync_ = 0;
    if (config.auto_baud == ConfigPacket::kAutoBaudResets) baud = start_baud;
  }

  void answer_config(ByteVector& answer) const {
    Frame frame = encode_config(config);
    if (config_checksum_is_wrong) frame.bytes[frame.size - 1] ^= 0x55U;
    append(answer, frame.view());
  }

  PacketScanner scanner_;
  int sync_ = 0;
};

/// Whether the driver may send these data: no command may move a wheel, enable a motor or change how the robot drives.
inline bool is_harmless(ByteView data) {
  const DecodedCommand command = decode_command(data);
  const bool has_no_argument = data.size() == 1;
  switch (static_cast<Command>(command.number)) {
    case Command::pulse:
    case Command::open:
    case Command::close:
    case Command::config:
      return has_no_argument;
    case Command::sonar:
      return command.value == 0;
    case Command::encoder:
      return command.value == 0 || command.value == 2;
    case Command::gyro:
      return command.value == 0 || command.value == 1;
    case Command::host_baud:
      return command.value && baud_of_code(*command.value);
    default:
      return false;
  }
}

}  // namespace azimuth::pioneer::test
