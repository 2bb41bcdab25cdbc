#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

#include "base/file_result.hpp"

namespace azimuth {

/// Largest size of a configuration or rig [bytes]. For scale: the rig of a thousand landmarks has some 60 kB.
inline constexpr std::size_t kLargestSettings = std::size_t{1} << 20U;

/// Largest size of a file that the settings name [bytes]. For scale: the DBC file of a whole lorry has some MB.
inline constexpr std::size_t kLargestText = std::size_t{1} << 24U;

/// Reads a text file. Returns one violation with the reason if the file cannot be read or is larger than kLargestText.
FileResult<std::string> file_text(const std::filesystem::path& file);

}  // namespace azimuth
