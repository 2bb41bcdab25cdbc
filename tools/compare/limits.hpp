#pragma once
// The limits of `azimuth report compare --limits FILE`.

#include <string>
#include <string_view>

#include "base/file_result.hpp"
#include "tools/compare/comparison.hpp"

namespace azimuth {

/// Reads limits from TOML text; missing values keep their defaults. All violations are reported; they name `file`.
FileResult<CompareSettings> read_limits(std::string_view text, const std::string& file);

}  // namespace azimuth
