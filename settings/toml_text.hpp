#pragma once
// TOML text to a tree, going on after a bad line. Internal to settings/.

#include <string>
#include <string_view>
#include <toml++/toml.h>

#include "base/file_result.hpp"

namespace azimuth {

/// A tree and what is wrong with its syntax.
struct ParsedToml {
  toml::table root;
  FileErrors violations;
  bool complete = true;  ///< false: text was lost whose keys cannot be judged, so check nothing further
};

/// The TOML library stops at the first error. A bad or repeated `key = value` line is reported, left out and the rest
/// parsed again, so that one slip does not hide the others. A text that is too large or too deep for it is not parsed.
ParsedToml parse_toml(std::string_view text, const std::string& file);

}  // namespace azimuth
