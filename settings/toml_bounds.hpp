#pragma once
// Limits on a text before the TOML library parses it, since the library's stack grows with the levels of a key.
// Internal to settings/.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/file_result.hpp"

namespace azimuth {

/// Largest number of levels of one key, and of lists and tables in values. Azimuth's own files have four levels.
inline constexpr int kMostTomlLevels = 32;

/// Returns why the text must not be parsed, with the line: it is larger than kLargestSettings or deeper than
/// kMostTomlLevels. Returns nothing for a text within both limits.
std::optional<FileError> beyond_toml_bounds(std::string_view text, const std::string& file);

}  // namespace azimuth
