#pragma once
// What a text must keep to before the TOML library sees it, whose stack grows with the levels of a key. Internal to
// settings/.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/file_result.hpp"

namespace azimuth {

inline constexpr int kMostTomlLevels = 32;  ///< of one key, and of lists and tables in values; ours have four

/// What forbids reading a text, with its line; nothing for one that is no larger than kLargestSettings and no deeper
/// than kMostTomlLevels.
std::optional<FileError> beyond_toml_bounds(std::string_view text, const std::string& file);

}  // namespace azimuth
