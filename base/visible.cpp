#include "base/visible.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace azimuth {
namespace {

/// A character with its length in bytes. For bytes that are not UTF-8: the first byte, as itself.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool is_whole = true;
};

Character character_at(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1, true};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  std::uint32_t code = first & (0xffU >> (bytes + 1));
  bool is_whole = first >= 0xc0 && first < 0xf8 && bytes <= text.size();
  for (std::size_t i = 1; i < bytes && is_whole; ++i) {
    is_whole = (byte(i) & 0xc0U) == 0x80;
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  is_whole = is_whole && code >= kLeast[bytes] && code <= 0x10ffff && !is_surrogate;
  return is_whole ? Character{code, bytes, true} : Character{first, 1, false};
}

/// Whether a terminal would execute the character, reorder text by it, or show nothing.
bool is_control(std::uint32_t code) {
  struct Range {
    std::uint32_t first, last;
  };
  constexpr std::array<Range, 9> kControls{{{0, 0x1f},
                                            {0x7f, 0x9f},
                                            {0xad, 0xad},
                                            {0x61c, 0x61c},
                                            {0x200b, 0x200f},
                                            {0x2028, 0x202e},
                                            {0x2060, 0x206f},
                                            {0xfeff, 0xfeff},
                                            {0xe0000, 0xe007f}}};
  return std::ranges::any_of(kControls, [&](const Range& range) { return code >= range.first && code <= range.last; });
}

std::string escaped(const Character& character) {
  if (character.code == '\n') return "\\n";
  if (character.code == '\t') return "\\t";
  if (character.code == '\r') return "\\r";
  std::array<char, 12> text{};
  const char* const form = character.bytes == 1 ? "\\x%02x" : "\\u%04x";
  std::snprintf(text.data(), text.size(), form, static_cast<unsigned>(character.code));
  return text.data();
}

std::string shown(std::string_view text, bool keep_line_ends) {
  std::string result;
  while (!text.empty()) {
    const Character character = character_at(text);
    const bool is_kept = keep_line_ends && character.code == '\n';
    if (is_kept || (character.is_whole && !is_control(character.code)))
      result += text.substr(0, character.bytes);
    else
      result += escaped(character);
    text.remove_prefix(character.bytes);
  }
  return result;
}

}  // namespace

std::string visible(std::string_view text) { return shown(text, false); }
std::string visible_lines(std::string_view text) { return shown(text, true); }

}  // namespace azimuth
