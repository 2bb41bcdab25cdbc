#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

#include "base/file_result.hpp"

namespace azimuth {

/// Of a text that settings are read from: of a thousand landmarks a rig has some 60 kB.
inline constexpr std::size_t kLargestSettings = std::size_t{1} << 20U;

/// Of a file that settings name, such as a DBC, which for a whole lorry has some MB.
inline constexpr std::size_t kLargestText = std::size_t{1} << 24U;

/// The whole of a text file, or one violation that says why it cannot be read: one of them is a size beyond
/// kLargestText.
FileResult<std::string> file_text(const std::filesystem::path& file);

}  // namespace azimuth
