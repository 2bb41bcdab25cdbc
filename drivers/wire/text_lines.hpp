#pragma once
// Lines of text tables, and quotations from them.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/visible.hpp"

namespace azimuth {

/// Removes the byte order mark that some editors put before UTF-8 text.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

/// Removes the first line from `text`, which must hold one, and returns it without its end (LF or CR LF).
inline std::string_view take_line(std::string_view& text) {
  const std::size_t length = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// The text in a form safe for a terminal, shortened to 40 bytes.
inline std::string printable(std::string_view text) {
  constexpr std::size_t kMostBytes = 40;
  std::size_t size = std::min(text.size(), kMostBytes);
  const auto is_within_letter = [&] { return (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80; };
  while (size > 0 && size < text.size() && is_within_letter()) --size;
  return visible(text.substr(0, size)) + (size < text.size() ? "..." : "");
}
inline std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

}  // namespace azimuth
