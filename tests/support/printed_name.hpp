#pragma once
// Names of the cases of a parameterised test, derived from the printed parameters.

#include <cctype>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace azimuth::test {

/// The text of a number, a text, or a type with its own PrintTo() or operator<<. Texts come without quotes and without
/// the address that GoogleTest prints for a pointer.
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

/// Keeps letters, digits and single underscores, the only characters that GoogleTest accepts. "-0.5" becomes
/// "minus_0_5".
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

/// Name generator for INSTANTIATE_TEST_SUITE_P: the printed parameter is the name of the case.
struct PrintedName {
  template <class T>
  std::string operator()(const testing::TestParamInfo<T>& info) const {
    return as_test_name(printed(info.param));
  }
};

}  // namespace azimuth::test
