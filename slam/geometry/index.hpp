#pragma once
// The library counts with unsigned numbers, Eigen and most of what is computed with signed ones.
//
// Thread contract: reentrant.

#include <cstddef>
#include <type_traits>

namespace azimuth {

template <class T>
concept Countable = std::is_integral_v<T> || std::is_enum_v<T>;

/// An index or a count that is not negative, for containers of the library.
constexpr std::size_t as_size(Countable auto count) { return static_cast<std::size_t>(count); }

/// The same for matrices: it is Eigen::Index.
constexpr std::ptrdiff_t as_index(Countable auto count) { return static_cast<std::ptrdiff_t>(count); }

}  // namespace azimuth
