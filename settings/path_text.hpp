#pragma once
// Resolves the relative paths of a configuration.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "settings/section.hpp"

namespace azimuth {

/// A resolved path of a configuration, and a warning for the user.
struct PlacedPath {
  std::filesystem::path path;
  std::string warning;  ///< empty: no warning
};

/// Resolves a relative path from `folder`. In 0.1.0 relative paths began in the working directory: until the next
/// release, a path that is found only there is still taken from there, with a warning. `exists` tells whether a file or
/// folder exists.
PlacedPath placed_path(const std::filesystem::path& path, const std::filesystem::path& folder,
                       const std::function<bool(const std::filesystem::path&)>& exists);

/// Resolves every path that the configuration `file` gave to `sections`. Returns one warning, which names the key, for
/// each path that should be written differently.
std::vector<std::string> place_paths(std::span<Section* const> sections, const std::filesystem::path& file);

}  // namespace azimuth
