#pragma once
// Parses TOML text into a tree and continues after a bad line. Internal to settings/.

#include <string>
#include <string_view>
#include <toml++/toml.h>

#include "base/file_result.hpp"

namespace azimuth {

/// The parsed tree, and the syntax errors.
struct ParsedToml {
  toml::table root;
  FileErrors violations;
  bool complete = true;  ///< false: the tree lacks keys of the text, so its content must not be checked
};

/// Parses the text. The TOML library stops at the first error; therefore the function reports a bad or repeated
/// `key = value` line, blanks it and parses the rest again, so that one error does not hide the others. A text larger
/// than kLargestSettings, or with more levels than any setting has, is not parsed.
ParsedToml parse_toml(std::string_view text, const std::string& file);

}  // namespace azimuth
