#pragma once
#include <span>
#include <string_view>

namespace azimuth {

/// A file of this folder that browsers read.
struct PageFile {
  std::string_view name;  ///< such as "map_view.js", "page.html"
  std::string_view text;
};

/// Style sheets, every module, each after those that it imports, and the page that loads them. Reentrant.
std::span<const PageFile> page_files();

}  // namespace azimuth
