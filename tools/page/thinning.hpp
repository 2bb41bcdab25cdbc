#pragma once
// Fewer instants of a long record, chosen so that no peak is lost.

#include <cstddef>
#include <span>
#include <vector>

namespace azimuth {

/// Indices of at most `most` of `count` instants, in order: the first and the last, and of each of many short stretches
/// the least and the greatest value of every series. Each series has `count` values; those that are no numbers are
/// passed over. All of them where `count` is no more than `most`.
///
/// `most` is at least 2 * (1 + series). Reentrant.
std::vector<std::size_t> thinned(std::size_t count, std::span<const std::span<const double>> series, std::size_t most);

}  // namespace azimuth
