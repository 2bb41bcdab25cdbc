#pragma once
// Assigns a TOML value to the member of a key. Internal to settings/.

#include <optional>
#include <string>
#include <string_view>
#include <toml++/toml.h>

#include "settings/section.hpp"

namespace azimuth {

/// Writes the value to the key's member. Returns a sentence, and leaves the member as it was, when the value is wrong.
std::optional<std::string> assign(Key& key, const toml::node& value);

/// The kind of a TOML value, in words.
std::string_view kind_of(const toml::node& value);

}  // namespace azimuth
