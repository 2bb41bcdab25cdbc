#pragma once
// Where the relative paths of a configuration begin.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "settings/section.hpp"

namespace azimuth {

/// A path that a configuration names, and what is to be told of it.
struct PlacedPath {
  std::filesystem::path path;
  std::string warning;  ///< empty: nothing
};

/// A relative path begins at `folder`. Until the next release one that is found in the working directory only, where it
/// began in 0.1.0, is still taken from there; `exists` tells whether a path is one of something.
PlacedPath placed_path(const std::filesystem::path& path, const std::filesystem::path& folder,
                       const std::function<bool(const std::filesystem::path&)>& exists);

/// Does so for every path that `sections` have been given, `file` being the configuration they were read from. A
/// warning for each that is to be written differently; it names the key.
std::vector<std::string> place_paths(std::span<Section* const> sections, const std::filesystem::path& file);

}  // namespace azimuth
