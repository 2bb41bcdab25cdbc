#pragma once
// The contents of the packets of the Pioneer protocol: commands to the robot, ids of its packets, and the encoding of
// commands.

#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// Commands, by the number in data[0]. Before OPEN, the numbers 0, 1 and 2 are the synchronisation instead.
enum class Command : std::uint8_t {
  pulse = 0,    // feeds the firmware's watchdog
  open = 1,     // begins the session: standard SIPs are sent from now on
  close = 2,    // ends the session
  polling = 3,  // text: the firing order of the sonars
  enable = 4,   // motors: 1 on, 0 off
  set_acceleration = 5,
  set_max_velocity = 6,
  set_origin = 7,  // sets the robot's x, y, heading to 0
  move = 8,
  rotate = 9,
  set_max_rotation = 10,
  velocity = 11,  // mm/s
  heading = 12,   // degrees
  relative_heading = 13,
  say = 15,
  joystick_info = 17,
  config = 18,    // requests a CONFIGpac
  encoder = 19,   // ENCODERpacs: 0 none, 1 one, 2 one in each cycle
  rotation = 21,  // deg/s
  heading_from_set_point = 22,
  set_rotation_acceleration = 23,
  imu_request = 26,
  sonar = 28,  // 0 off
  stop = 29,
  digital_out = 30,
  wheel_velocities = 32,
  analog_select = 35,
  io_request = 40,  // IOpacs: 0 none, 1 one, 2 one in each cycle
  tty2 = 42,
  get_aux = 43,
  bump_stall = 44,
  joystick_drive = 47,
  sonar_cycle = 48,
  host_baud = 50,  // see baud_code()
  aux1_baud = 51,
  aux2_baud = 52,
  emergency_stop = 55,
  gyro = 58,  // GYROpacs: 1 on, 0 off
  tty4 = 60,
  battery_info = 62,
  tty3 = 66,
  get_aux2 = 67,
  rotation_kp = 82,  // 82 to 87, translation_ki: the controller's gains
  translation_ki = 87,
  simulator_set_pose = 224,  // simulators only: three int32, mm, mm, deg
  simulator_reset = 225,
  simulator_status = 237,
  simulator_exit = 239,
  battery_test = 250,
};

/// Synchronisation: the robot echoes each of these. The echo of sync2 carries the robot's name, class and subclass.
inline constexpr std::uint8_t kSync0 = 0, kSync1 = 1, kSync2 = 2;

/// Ids of the robot's packets.
namespace packet_id {
enum Value : std::uint8_t {
  config = 0x20,
  sip_first = 0x30,
  sip_stopped = 0x32,
  sip_moving = 0x33,
  sip_last = 0x34,
  encoder = 0x90,
  gyro = 0x98,
  imu = 0x9A,
  io = 0xF0,
  battery = 0xFA,
  reboot_with_data = 0xFE,
  reboot = 0xFF,  // the controller restarted; during synchronisation: a wrong sync number
};
/// True: the packet is a standard SIP. The particular id does not tell reliably whether the robot moves.
constexpr bool is_sip(std::uint8_t id) { return id >= sip_first && id <= sip_last; }
}  // namespace packet_id

/// The encoding of a command's argument.
enum class ArgumentType : std::uint8_t { positive = 0x3B, negative = 0x1B, text = 0x2B };

/// Longest text argument.
inline constexpr std::size_t kMaxArgumentText = 195;

Frame encode_command(std::uint8_t number);
/// `argument` is within +-32767.
Frame encode_command(std::uint8_t number, int argument);
/// `argument` has at most kMaxArgumentText bytes.
Frame encode_command(std::uint8_t number, std::string_view argument);

inline Frame encode_command(Command command) { return encode_command(static_cast<std::uint8_t>(command)); }
template <class Argument>
Frame encode_command(Command command, Argument argument) {
  return encode_command(static_cast<std::uint8_t>(command), argument);
}

/// A command as decoded by the robot's side.
struct DecodedCommand {
  std::uint8_t number = 0;
  std::optional<int> value;              ///< value of an integer argument
  std::optional<std::string_view> text;  ///< a text argument; borrows from the packet
  ByteView argument;                     ///< all bytes after the number
  bool is(Command command) const { return number == static_cast<std::uint8_t>(command); }
};

/// `data` are those of a packet, not empty. A truncated argument, or one of unknown type, is only in `argument`.
DecodedCommand decode_command(ByteView data);

/// The argument of host_baud for a baud rate, and the reverse; none for rates that the controller does not have.
std::optional<int> baud_code(int baud);
std::optional<int> baud_of_code(int code);

}  // namespace azimuth::pioneer
