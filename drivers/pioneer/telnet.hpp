#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace azimuth::pioneer {

/// Undoes the changes that a serial-to-Ethernet bridge in telnet mode makes to the robot's bytes: it sends 0xFF twice,
/// and inserts commands (RFC 854). Such a bridge begins a connection with commands. A bridge in raw mode never does,
/// because a controller's first byte is 0xFA, so its bytes are left unchanged.
///
/// Thread contract: thread-bound; allocates nothing.
class Telnet {
 public:
  static constexpr std::uint8_t kCommand = 0xFF;

  /// Processes the next bytes of the connection in place. Returns how many of them are the robot's.
  std::size_t undo(std::span<std::uint8_t> bytes);
  bool is_spoken() const { return spoken_; }
  /// The answer to send next; none: there is none. Only binary transmission is agreed to, because without it a bridge
  /// may insert a byte after each 0x0D.
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
  // For each direction: binary transmission was offered and waits for an answer; it was agreed to.
  bool offered_[2] = {}, agreed_[2] = {};
};

}  // namespace azimuth::pioneer
