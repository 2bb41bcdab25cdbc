#pragma once
// Whole text files. Internal to drivers/io.

#include <filesystem>
#include <string>
#include <string_view>

#include "base/file_result.hpp"

namespace azimuth {

/// The whole of a regular file.
FileResult<std::string> read_text_file(const std::filesystem::path& file);

/// Replaces the file's content.
[[nodiscard]] FileResult<void> write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace azimuth
