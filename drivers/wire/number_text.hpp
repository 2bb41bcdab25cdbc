#pragma once
// Numbers as text, both ways without loss.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "slam/sample/stamp.hpp"

namespace azimuth {

// Nothing unless the whole of `text` is one number; no spaces, no leading '+'.
std::optional<double> parse_double(std::string_view text);  ///< may be infinite or NaN if the text says so
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Seconds to microseconds, exactly; decimals beyond the sixth are rounded. Nothing outside plausible.hpp's bounds.
std::optional<Stamp> parse_seconds(std::string_view text);

/// The shortest digits that give the same double back.
void append_double(std::string& out, double value);
void append_integer(std::string& out, std::int64_t value);

/// Seconds with six decimals.
void append_seconds(std::string& out, Stamp stamp);

}  // namespace azimuth
