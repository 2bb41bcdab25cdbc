#pragma once
#include <string_view>

namespace azimuth {

/// Whether an earlier version had the key in the table `section` ("ekf", "daemon.can"). Files with such keys stay
/// valid.
bool is_retired(std::string_view section, std::string_view key);

/// The end of a sentence about a retired key.
constexpr std::string_view kRetiredKey = "it is a key no more: the value that measured best is built in";

}  // namespace azimuth
