#pragma once
// The limits of `azimuth compare --limits FILE`.

#include <string>
#include <string_view>

#include "base/file_result.hpp"
#include "tools/compare/comparison.hpp"

namespace azimuth {

/// Reads the TOML text of limits over the defaults; `file` is what violations name, every one of which is told.
FileResult<CompareSettings> read_limits(std::string_view text, const std::string& file);

}  // namespace azimuth
