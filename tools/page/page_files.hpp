#pragma once
#include <span>
#include <string_view>

namespace azimuth {

/// An embedded file of this folder for browsers.
struct PageFile {
  std::string_view name;  ///< such as "map_view.js", "page.html"
  std::string_view text;
};

/// All style sheets, all modules (each after its imports), and the page that loads them. Reentrant.
std::span<const PageFile> page_files();

}  // namespace azimuth
