#pragma once
#include <filesystem>
#include <string>

#include "base/file_result.hpp"

namespace azimuth {

/// The whole of a text file, or one violation that says why it cannot be read.
FileResult<std::string> file_text(const std::filesystem::path& file);

}  // namespace azimuth
