#pragma once
#include <cstddef>
#include <utility>

namespace azimuth {

/// Converts to a member of any type in the count below.
struct AnyMember {
  template <class T>
  operator T() const;  // never defined; only used in requires-expressions
};

template <class T, std::size_t... I>
constexpr bool takes_members(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyMember{})...}; };
}

/// Number of members of an aggregate: the largest number of initialisers that it accepts. Tests compare it with the
/// tables of settings, so that a new member without an entry fails a test.
template <class T, std::size_t N = 0>
constexpr std::size_t member_count() {
  if constexpr (takes_members<T>(std::make_index_sequence<N + 1>())) {
    return member_count<T, N + 1>();
  } else {
    return N;
  }
}

/// The same number with the members of `Groups` counted instead of the groups, each of which is a member of T.
template <class T, class... Groups>
constexpr std::size_t member_count_with_groups() {
  return member_count<T>() - sizeof...(Groups) + (member_count<Groups>() + ...);
}

}  // namespace azimuth
