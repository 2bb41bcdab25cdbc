#pragma once
// One TOML value into one key's member. Internal to settings/.

#include <optional>
#include <string>
#include <string_view>
#include <toml++/toml.h>

#include "settings/section.hpp"

namespace azimuth {

/// Writes the value to the key's member, or says why not and leaves the member alone.
std::optional<std::string> assign(Key& key, const toml::node& value);

/// The kind of a TOML value, in words.
std::string_view kind_of(const toml::node& value);

}  // namespace azimuth
