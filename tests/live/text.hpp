#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace azimuth::test {

/// Counts the occurrences of `part` in `text`, without overlaps.
inline std::size_t occurrences(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// The number before the last occurrence of `unit`, as in "12 landmarks"; -1 if there is none.
inline int last_number_before(const std::string& text, const std::string& unit) {
  const std::size_t end = text.rfind(' ' + unit);
  if (end == std::string::npos || end == 0) return -1;
  return std::stoi(text.substr(text.find_last_of(' ', end - 1) + 1));
}

}  // namespace azimuth::test
