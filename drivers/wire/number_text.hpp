#pragma once
// Numbers as text, in both directions without loss.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "slam/sample/stamp.hpp"

namespace azimuth {

// These functions return none unless the whole of `text` is one number, without spaces and without a leading '+'.
std::optional<double> parse_double(std::string_view text);  ///< may be infinite or NaN if the text says so
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Seconds to microseconds, exactly; decimals beyond the sixth are rounded. None outside the bounds of plausible.hpp.
std::optional<Stamp> parse_seconds(std::string_view text);

/// Appends the shortest digits that restore the same double.
void append_double(std::string& out, double value);
void append_integer(std::string& out, std::int64_t value);

/// Appends seconds with six decimals.
void append_seconds(std::string& out, Stamp stamp);

}  // namespace azimuth
