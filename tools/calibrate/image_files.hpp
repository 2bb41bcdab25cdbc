#pragma once
#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/file_result.hpp"

namespace azimuth {

/// The image files that arguments of the command line name: files as they are, of folders all images in them by name,
/// of run folders those in `frames`. At most `most`, evenly spread.
FileResult<std::vector<std::filesystem::path>> image_files(const std::vector<std::filesystem::path>& arguments,
                                                           std::size_t most);

/// At most `most` of `files`, evenly spread, each with the one after it.
std::vector<std::pair<std::filesystem::path, std::filesystem::path>> image_pairs(
    const std::vector<std::filesystem::path>& files, std::size_t most);

}  // namespace azimuth
