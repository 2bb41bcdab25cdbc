#pragma once
// What somebody who wrote an unknown word probably meant.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace azimuth {

/// Letters to insert, delete, replace or swap with their neighbour to get from one word to the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known word nearest to `word`, whatever its case, unless even that is too far off to be meant: by more than a
/// third of the letters of the shorter one.
std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known);

/// The unit a key's name ends in ("rad" of sigma_bearing_rad), or empty. A compound unit (rad2_per_m) counts whole.
std::string_view unit_of(std::string_view key);

/// A known key which is `key` but for its unit (sigma_bearing_deg, sigma_bearing -> sigma_bearing_rad); of
/// several the one that measures the same thing (beyond_deg -> beyond_rad, not beyond_m).
std::optional<std::string_view> same_but_unit(std::string_view key, std::span<const std::string_view> known);

/// `value` in `from_unit` expressed in `to_unit`, where both measure the same thing.
std::optional<double> converted(double value, std::string_view from_unit, std::string_view to_unit);

}  // namespace azimuth
