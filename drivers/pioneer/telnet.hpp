#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace azimuth::pioneer {

/// What a serial-to-Ethernet bridge in telnet mode makes of the robot's bytes, undone: 0xFF comes twice, and commands
/// come in between (RFC 854). Such a bridge begins a connection with commands; one in raw mode never does, as what a
/// controller sends first begins with 0xFA, so its bytes are left alone.
///
/// Thread contract: thread-bound; allocates nothing.
class Telnet {
 public:
  static constexpr std::uint8_t kCommand = 0xFF;

  /// The next bytes of the connection, in place; how many of them are the robot's.
  std::size_t undo(std::span<std::uint8_t> bytes);
  bool is_spoken() const { return spoken_; }
  /// The answer to send next; nothing: none is due. Binary transmission alone is agreed to: without it a bridge may
  /// put something behind each 0x0D.
  struct Answer {
    std::uint8_t command, option;
  };
  std::optional<Answer> take_answer();

 private:
  enum class State { beginning, begun_by_ff, raw, data, command, option, subnegotiation, subnegotiation_command };
  bool passes(std::uint8_t byte);
  bool begin(std::uint8_t byte);
  void obey(std::uint8_t command);
  void agree(std::uint8_t option);

  State state_ = State::beginning;
  bool spoken_ = false;
  std::uint8_t command_ = 0;
  // Binary transmission, each way, was offered and is to be agreed to; was agreed to.
  bool offered_[2] = {}, agreed_[2] = {};
};

}  // namespace azimuth::pioneer
