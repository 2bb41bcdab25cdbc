#pragma once
// Tables as text: their lines, and what may be quoted of them.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace azimuth {

/// What some editors put before the text of a file in UTF-8 is no text.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

/// Takes the first line off the front of `text`, which holds one, without its end: LF or CR LF.
inline std::string_view take_line(std::string_view& text) {
  const std::size_t length = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// As it may be shown on a terminal: cut short, and ? for what is not printable ASCII.
inline std::string printable(std::string_view text) {
  constexpr std::size_t kMostLetters = 40;
  std::string letters;
  for (const char c : text.substr(0, kMostLetters)) letters += c >= ' ' && c <= '~' ? c : '?';
  return letters + (text.size() > kMostLetters ? "..." : "");
}
inline std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

}  // namespace azimuth
