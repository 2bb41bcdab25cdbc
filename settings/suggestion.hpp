#pragma once
// Suggestions for unknown words: what the user probably meant.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace azimuth {

/// Number of letters to insert, delete, replace or swap with their neighbour to turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known word nearest to `word`, without regard to case. Returns nothing if the distance exceeds a third of the
/// letters of the shorter word.
std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known);

/// The unit at the end of a key's name ("rad" of sigma_bearing_rad), or empty. A compound unit (rad2_per_m) is one
/// unit.
std::string_view unit_of(std::string_view key);

/// A known key that differs from `key` only in the unit (sigma_bearing_deg, sigma_bearing -> sigma_bearing_rad). Among
/// several such keys, one of the same dimension is preferred (beyond_deg -> beyond_rad, not beyond_m).
std::optional<std::string_view> same_but_unit(std::string_view key, std::span<const std::string_view> known);

/// Converts `value` from `from_unit` to `to_unit`; nothing if the units have different dimensions.
std::optional<double> converted(double value, std::string_view from_unit, std::string_view to_unit);

}  // namespace azimuth
