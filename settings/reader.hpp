#pragma once
// Reads TOML text into the settings structs, by their tables.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// Sets the members of `sections` that the TOML `text` gives. Reports every violation in the text: syntax, duplicates,
/// unknown sections and keys (with the nearest known one), wrong units, types and ranges, NaN and infinity. A key with
/// a wrong value leaves its member as it was.
///
/// Violations name `file`. The function ignores tables under the names in `others`, which belong to another program. It
/// also ignores the keys of earlier versions, with a sentence in `warnings`; without `warnings` they are violations.
///
/// Reentrant. Throws nothing but std::bad_alloc, whatever the text.
FileErrors read_toml(std::string_view text, const std::string& file, std::span<Section* const> sections,
                     std::span<const std::string_view> others = {}, std::vector<std::string>* warnings = nullptr);

/// Applies one `section.key=value` of the command line. A text needs no quotes.
FileErrors apply_override(const std::string& assignment, std::span<Section* const> sections);

}  // namespace azimuth
