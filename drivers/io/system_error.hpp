#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "base/file_result.hpp"

namespace azimuth {

/// `what`, and why the system says so.
inline FileError system_error(const std::filesystem::path& file, std::string_view what, int error_number) {
  return {file.string(), 0, std::string(what) + ": " + std::generic_category().message(error_number)};
}

}  // namespace azimuth
