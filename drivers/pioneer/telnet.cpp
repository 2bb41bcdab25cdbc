#include "drivers/pioneer/telnet.hpp"

#include <utility>

namespace azimuth::pioneer {
namespace {

constexpr std::uint8_t kWill = 0xFB, kDo = 0xFD, kDont = 0xFE, kBegin = 0xFA, kEnd = 0xF0;
constexpr std::uint8_t kBinary = 0;

constexpr bool has_option(std::uint8_t command) { return command >= kWill && command <= kDont; }

}  // namespace

std::size_t Telnet::undo(std::span<std::uint8_t> bytes) {
  if (state_ == State::raw) return bytes.size();
  std::size_t kept = 0;
  for (const std::uint8_t byte : bytes)
    if (passes(byte)) bytes[kept++] = byte;
  return kept;
}

bool Telnet::passes(std::uint8_t byte) {
  switch (state_) {
    case State::raw:
      return true;
    case State::beginning:
    case State::begun_by_ff:
      return begin(byte);
    case State::data:
      if (byte == kCommand) state_ = State::command;
      return byte != kCommand;
    case State::command:
      state_ = State::data;
      if (byte != kCommand) obey(byte);
      return byte == kCommand;
    case State::option:
      state_ = State::data;
      agree(byte);
      return false;
    case State::subnegotiation:
      if (byte == kCommand) state_ = State::subnegotiation_command;
      return false;
    case State::subnegotiation_command:
      state_ = byte == kEnd ? State::data : State::subnegotiation;
      return false;
  }
  return true;
}

/// A first 0xFF that does not belong to telnet is dropped. It lies in the middle of a packet that cannot be used
/// anyway.
bool Telnet::begin(std::uint8_t byte) {
  if (state_ == State::beginning) {
    state_ = byte == kCommand ? State::begun_by_ff : State::raw;
    return byte != kCommand;
  }
  spoken_ = has_option(byte) || byte == kBegin;
  state_ = spoken_ ? State::data : State::raw;
  if (spoken_) obey(byte);
  return !spoken_;
}

void Telnet::obey(std::uint8_t command) {
  command_ = command;
  if (has_option(command)) state_ = State::option;
  if (command == kBegin) state_ = State::subnegotiation;
}

void Telnet::agree(std::uint8_t option) {
  if (option != kBinary) return;
  if (command_ == kWill) offered_[0] = true;
  if (command_ == kDo) offered_[1] = true;
}

std::optional<Telnet::Answer> Telnet::take_answer() {
  for (const std::size_t way : {0U, 1U}) {
    if (!std::exchange(offered_[way], false) || std::exchange(agreed_[way], true)) continue;
    return Answer{way == 0 ? kDo : kWill, kBinary};
  }
  return std::nullopt;
}

}  // namespace azimuth::pioneer
