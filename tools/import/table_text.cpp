// Character encodings and times in the text of tables.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "drivers/wire/number_text.hpp"
#include "tools/import/foreign_table.hpp"

namespace azimuth {
namespace {

/// Removes `digits` digits from the front of `text`; nothing if there are fewer.
std::optional<unsigned> take_number(std::string_view& text, std::size_t digits) {
  unsigned number = 0;
  if (text.size() < digits) return std::nullopt;
  for (std::size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    number = 10 * number + static_cast<unsigned>(text[i] - '0');
  }
  text.remove_prefix(digits);
  return number;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

std::optional<std::chrono::sys_days> take_date(std::string_view& text) {
  const auto y = take_number(text, 4);
  const bool dash = y && take(text, '-');
  const auto m = dash ? take_number(text, 2) : std::nullopt;
  const bool second_dash = m && take(text, '-');
  const auto d = second_dash ? take_number(text, 2) : std::nullopt;
  if (!d) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year{static_cast<int>(*y)}, std::chrono::month{*m},
                                         std::chrono::day{*d}};
  return date.ok() ? std::optional(std::chrono::sys_days(date)) : std::nullopt;
}

/// Parses hours and minutes. The result is in seconds.
std::optional<std::int64_t> take_clock(std::string_view& text, bool colon_is_needed) {
  const auto hours = take_number(text, 2);
  const bool colon = hours && (take(text, ':') || !colon_is_needed);
  const auto minutes = colon ? take_number(text, 2) : std::nullopt;
  if (!minutes || *hours > 24 || *minutes > 59) return std::nullopt;
  return 3600 * static_cast<std::int64_t>(*hours) + 60 * static_cast<std::int64_t>(*minutes);
}

/// Parses a time zone: Z, +02:00, -0730 or +01. An empty text means UTC.
std::optional<std::int64_t> offset_of(std::string_view text) {
  if (text.empty() || text == "Z" || text == "z" || text == "UTC" || text == " UTC") return 0;
  const std::int64_t sign = text.front() == '-' ? -1 : 1;
  if (!take(text, '+') && !take(text, '-')) return std::nullopt;
  std::string whole(text);
  if (whole.size() == 2) whole += "00";
  std::string_view clock = whole;
  const auto offset_s = take_clock(clock, false);
  return offset_s && clock.empty() ? std::optional(sign * *offset_s) : std::nullopt;
}

/// Appends a character of the Basic Multilingual Plane. Surrogates become '?'.
void append_utf8(std::string& out, unsigned letter) {
  if (letter >= 0xD800 && letter < 0xE000) letter = '?';
  if (letter < 0x80) {
    out += static_cast<char>(letter);
    return;
  }
  if (letter < 0x800) {
    out += static_cast<char>(0xC0U | letter >> 6U);
  } else {
    out += static_cast<char>(0xE0U | letter >> 12U);
    out += static_cast<char>(0x80U | (letter >> 6U & 0x3FU));
  }
  out += static_cast<char>(0x80U | (letter & 0x3FU));
}

}  // namespace

std::string in_utf8(std::string text) {
  const auto byte = [&text](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
  if (text.size() < 2) return text;
  const bool is_little = byte(0) == 0xFF && byte(1) == 0xFE, is_big = byte(0) == 0xFE && byte(1) == 0xFF;
  if (!is_little && !is_big) return text;
  std::string utf8;
  for (std::size_t i = 2; i + 1 < text.size(); i += 2)
    append_utf8(utf8, is_little ? byte(i) | byte(i + 1) << 8U : byte(i + 1) | byte(i) << 8U);
  return utf8;
}

std::optional<Stamp> parse_time(std::string_view text, int digits) {
  if (digits == 0) return parse_seconds(text);
  std::string seconds;
  if (text.find_first_of("eE") != std::string_view::npos) {
    const std::optional<double> value = parse_double(text);
    if (!value) return std::nullopt;
    append_double(seconds, *value * std::pow(10.0, -digits));
    return parse_seconds(seconds);
  }
  if (text.starts_with('-')) {
    seconds = "-";
    text.remove_prefix(1);
  }
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view fraction = point < text.size() ? text.substr(point + 1) : std::string_view{};
  if (point == 0) return std::nullopt;
  // The decimal point is moved in the text, because a double cannot hold 19 digits.
  const auto shift = static_cast<std::size_t>(digits);
  std::string whole(text.substr(0, point));
  if (whole.size() <= shift) whole.insert(0, shift + 1 - whole.size(), '0');
  seconds.append(whole, 0, whole.size() - shift).append(1, '.').append(whole, whole.size() - shift).append(fraction);
  return parse_seconds(seconds);
}

std::optional<Stamp> parse_date(std::string_view text) {
  const auto date = take_date(text);
  if (!date || (!take(text, 'T') && !take(text, ' '))) return std::nullopt;
  const auto clock_s = take_clock(text, true);
  if (!clock_s) return std::nullopt;
  std::string seconds = "0";
  if (take(text, ':')) {
    const std::size_t end = text.find_first_not_of("0123456789.,");
    seconds = text.substr(0, end);
    for (char& letter : seconds) letter = letter == ',' ? '.' : letter;
    text.remove_prefix(seconds.size());
  }
  const auto offset_s = offset_of(text);
  const std::optional<Stamp> beyond = parse_seconds(seconds);
  if (!offset_s || !beyond || *beyond - Stamp{} >= Duration{61'000'000}) return std::nullopt;
  const std::int64_t whole_s = std::int64_t{86'400} * date->time_since_epoch().count() + *clock_s - *offset_s;
  return *beyond + Duration{1'000'000 * whole_s};
}

}  // namespace azimuth
