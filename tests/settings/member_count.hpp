#pragma once
#include <cstddef>
#include <utility>

namespace azimuth {

/// Stands for a member of any type in the count below.
struct AnyMember {
  template <class T>
  operator T() const;  // never defined: only asked about
};

template <class T, std::size_t... I>
constexpr bool takes_members(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyMember{})...}; };
}

/// How many members an aggregate has: the most initialisers it takes. A settings struct that gains a member fails the
/// test that compares this with its table.
template <class T, std::size_t N = 0>
constexpr std::size_t member_count() {
  if constexpr (takes_members<T>(std::make_index_sequence<N + 1>())) {
    return member_count<T, N + 1>();
  } else {
    return N;
  }
}

/// The same with the members of these groups, each a member of T, in their place.
template <class T, class... Groups>
constexpr std::size_t member_count_with_groups() {
  return member_count<T>() - sizeof...(Groups) + (member_count<Groups>() + ...);
}

}  // namespace azimuth
