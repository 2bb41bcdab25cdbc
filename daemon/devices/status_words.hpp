#pragma once
// The words of a device's status, the same for every device. Into storage that is used again: once a second is often
// enough to matter.

#include <cstdint>
#include <fmt/format.h>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>

#include "drivers/device/connection.hpp"

namespace azimuth {

/// Replaces `words` by the connection, and why it is not running: "away: can0: no such interface".
inline void put_state(const DeviceState& state, std::string& words) {
  words = text(state.connection);
  if (state.connection != Connection::running && !state.trouble.empty()) words.append(": ").append(state.trouble);
}

/// Appends those that there were: ", 3 missing, 1 corrupt".
inline void append_losses(std::initializer_list<std::pair<std::uint64_t, const char*>> losses, std::string& words) {
  for (const auto& [count, what] : losses)
    if (count > 0) fmt::format_to(std::back_inserter(words), ", {} {}", count, what);
}

/// A bit of DeviceStatus::robot_flags.
constexpr std::uint32_t robot_flag(bool is_set, std::int32_t bit) {
  return is_set ? static_cast<std::uint32_t>(bit) : 0U;
}

}  // namespace azimuth
