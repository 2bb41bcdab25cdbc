#pragma once
#include <filesystem>
#include <string>

#include "settings/outcome.hpp"

namespace azimuth {

/// The whole of a text file, or one violation that says why it cannot be read.
Outcome<std::string> file_text(const std::filesystem::path& file);

}  // namespace azimuth
