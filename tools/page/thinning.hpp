#pragma once
// Selects instants of a long record such that peaks are kept.

#include <cstddef>
#include <span>
#include <vector>

namespace azimuth {

/// Indices of at most `most` out of `count` instants, in ascending order. They include the first and the last instant,
/// and for each of many short stretches the minimum and the maximum of every series. Each series has `count` values;
/// values that are not finite are ignored. If `count` is at most `most`, all indices are returned.
///
/// `most` is at least 2 * (1 + series). Reentrant.
std::vector<std::size_t> thinned(std::size_t count, std::span<const std::span<const double>> series, std::size_t most);

}  // namespace azimuth
