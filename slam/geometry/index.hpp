#pragma once
// Conversions between the unsigned counts of the standard library and the signed ones of Eigen and arithmetic.
//
// Thread contract: reentrant.

#include <cstddef>
#include <type_traits>

namespace azimuth {

template <class T>
concept Countable = std::is_integral_v<T> || std::is_enum_v<T>;

/// Converts a non-negative index or count for containers of the standard library.
constexpr std::size_t as_size(Countable auto count) { return static_cast<std::size_t>(count); }

/// Converts an index or count for Eigen's matrices; the type is Eigen::Index.
constexpr std::ptrdiff_t as_index(Countable auto count) { return static_cast<std::ptrdiff_t>(count); }

}  // namespace azimuth
