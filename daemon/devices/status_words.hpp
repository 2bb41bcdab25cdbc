#pragma once
// The text of a device's status, the same for every device. It is written into reused storage, because it is made once
// a second.

#include <cstdint>
#include <fmt/format.h>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>

#include "drivers/device/connection.hpp"

namespace azimuth {

/// Replaces `words` by the connection and, if it is not running, the cause: "away: can0: no such interface".
inline void put_state(const DeviceState& state, std::string& words) {
  words = text(state.connection);
  if (state.connection != Connection::running && !state.trouble.empty()) words.append(": ").append(state.trouble);
}

/// Appends all nonzero counts: ", 3 missing, 1 corrupt".
inline void append_losses(std::initializer_list<std::pair<std::uint64_t, const char*>> losses, std::string& words) {
  for (const auto& [count, what] : losses)
    if (count > 0) fmt::format_to(std::back_inserter(words), ", {} {}", count, what);
}

/// `bit` if `is_set`, else 0; for DeviceStatus::robot_flags.
constexpr std::uint32_t robot_flag(bool is_set, std::int32_t bit) {
  return is_set ? static_cast<std::uint32_t>(bit) : 0U;
}

}  // namespace azimuth
