#pragma once
// Names of a parameterised test's cases, from what the parameters print as.

#include <cctype>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace azimuth::test {

/// A number, a text or something that has a PrintTo() or operator<< of its own. Texts without the quotes, and without
/// the address that GoogleTest prints with a pointer.
template <class T>
std::string printed(const T& value) {
  if constexpr (std::is_convertible_v<T, std::string_view>)
    return std::string(std::string_view(value));
  else
    return testing::PrintToString(value);
}
template <class... T>
std::string printed(const std::tuple<T...>& values) {
  return std::apply([](const T&... each) { return ((printed(each) + ' ') + ...); }, values);
}

/// Letters, digits and single underscores: all that GoogleTest takes. "-0.5" becomes "minus_0_5".
inline std::string as_test_name(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto is = [&](std::size_t at, int (*kind)(int)) {
      return at < text.size() && kind(static_cast<unsigned char>(text[at])) != 0;
    };
    const bool is_sign = text[i] == '-' && is(i + 1, std::isdigit) && (i == 0 || !is(i - 1, std::isalnum));
    if (is(i, std::isalnum))
      name += text[i];
    else if (is_sign)
      name += "minus_";
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  return name;
}

/// For INSTANTIATE_TEST_SUITE_P: each case is called what its parameter prints as.
struct PrintedName {
  template <class T>
  std::string operator()(const testing::TestParamInfo<T>& info) const {
    return as_test_name(printed(info.param));
  }
};

}  // namespace azimuth::test
