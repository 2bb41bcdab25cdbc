#pragma once
#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/file_result.hpp"

namespace azimuth {

/// The image files that command-line arguments name. A file stands for itself, a folder for all its images sorted by
/// name, a run folder for the images in its `frames` folder. If there are more than `most`, returns an evenly spaced
/// selection of `most`.
FileResult<std::vector<std::filesystem::path>> image_files(const std::vector<std::filesystem::path>& arguments,
                                                           std::size_t most);

/// Pairs of successive `files`. If there are more than `most` pairs, returns an evenly spaced selection of `most`.
std::vector<std::pair<std::filesystem::path, std::filesystem::path>> image_pairs(
    const std::vector<std::filesystem::path>& files, std::size_t most);

}  // namespace azimuth
