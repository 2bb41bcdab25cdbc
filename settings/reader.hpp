#pragma once
// TOML text into settings structs, by their tables.

#include <span>
#include <string>
#include <string_view>

#include "base/file_result.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// Sets the members of `sections` that the TOML `text` gives, and reports everything that is wrong with it: syntax,
/// duplicates, unknown sections and keys (with the nearest known one), wrong units, types and ranges, NaN and infinity.
/// A key that is wrong leaves its member as it was.
///
/// `file` is what violations name. Tables under the names in `others` belong to another program and are passed over.
///
/// Reentrant. Throws nothing but std::bad_alloc, whatever the text.
FileErrors read_toml(std::string_view text, const std::string& file, std::span<Section* const> sections,
                     std::span<const std::string_view> others = {});

/// Applies one `section.key=value` of the command line; the value may leave out the quotes of a text.
FileErrors apply_override(const std::string& assignment, std::span<Section* const> sections);

}  // namespace azimuth
