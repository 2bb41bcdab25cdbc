#include "settings/path_text.hpp"

#include <fmt/format.h>
#include <string_view>
#include <system_error>
#include <utility>

namespace azimuth {
namespace {

namespace fs = std::filesystem;

bool exists_on_disk(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// Whether the path exists below `folder`, or its parent folder exists so that the file can be made there.
bool is_found(const fs::path& path, const fs::path& folder, const std::function<bool(const fs::path&)>& exists) {
  return exists(folder / path) || (path.has_parent_path() && exists(folder / path.parent_path()));
}

std::string key_name(const Section& section, const Key& key) {
  return section.name.empty() ? std::string(key.name) : fmt::format("{}.{}", section.name, key.name);
}

/// Replaces the path in the text by the resolved one. Returns the warning, or an empty text.
std::string place(const PathText& target, const fs::path& folder) {
  std::string& text = *target.text;
  const std::string_view named = target.path_in(text);
  if (named.empty()) return "";
  PlacedPath placed = placed_path(named, folder, exists_on_disk);
  const auto at = static_cast<std::size_t>(named.data() - text.data());
  text.replace(at, named.size(), placed.path.string());
  return std::move(placed.warning);
}

}  // namespace

PlacedPath placed_path(const fs::path& path, const fs::path& folder,
                       const std::function<bool(const fs::path&)>& exists) {
  std::error_code ignored;
  const fs::path here = fs::current_path(ignored);
  const fs::path there = here / folder;
  if (path.is_absolute()) return {path, ""};
  const fs::path begun = (folder / path).lexically_normal();
  if (!is_found(path, here, exists)) return {begun, ""};
  const std::string whole = (here / path).lexically_normal().string();
  if (is_found(path, there, exists))
    return {begun, fmt::format("\"{}\" is {}, and no longer {}: relative paths begin at the configuration's folder",
                               path.string(), begun.string(), whole)};
  return {path,
          fmt::format("\"{}\" is not in the configuration's folder, where relative paths begin; it is still taken "
                      "from the working directory, but in the next release no more: write \"{}\"",
                      path.string(), whole)};
}

std::vector<std::string> place_paths(std::span<Section* const> sections, const fs::path& file) {
  std::vector<std::string> warnings;
  std::error_code ignored;
  if (!file.has_parent_path() || fs::equivalent(file.parent_path(), fs::current_path(ignored), ignored)) return {};
  for (Section* const section : sections)
    for (Key& key : section->keys) {
      const PathText* const target = std::get_if<PathText>(&key.target);
      if (!target || !key.given) continue;
      std::string warning = place(*target, file.parent_path());
      if (!warning.empty())
        warnings.push_back(fmt::format("{}: {} {}", file.string(), key_name(*section, key), warning));
    }
  return warnings;
}

}  // namespace azimuth
