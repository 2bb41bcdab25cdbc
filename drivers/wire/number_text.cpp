#include "drivers/wire/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "drivers/wire/plausible.hpp"

namespace azimuth {

namespace {

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

template <class Number>
void append(std::string& out, Number value) {
  std::array<char, 32> digits;  // the longest double in shortest form has 24 characters
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), end);
}

constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;
constexpr std::int64_t kMaxSeconds = kMaxStamp_us / kMicrosecondsPerSecond;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<Stamp> parse_scientific_seconds(std::string_view text) {
  const std::optional<double> seconds = parse_double(text);
  if (!seconds || !(std::abs(*seconds) <= static_cast<double>(kMaxSeconds))) return std::nullopt;
  return Stamp{duration_from_seconds(*seconds)};
}

std::optional<std::int64_t> parse_whole_seconds(std::string_view digits) {
  std::int64_t seconds = 0;
  for (const char digit : digits) {
    seconds = 10 * seconds + (digit - '0');
    if (seconds >= kMaxSeconds) return std::nullopt;
  }
  return seconds;
}

/// Microseconds from the digits after the point, rounded; up to a whole second.
std::int64_t rounded_microseconds(std::string_view decimals) {
  std::int64_t microseconds = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    microseconds = 10 * microseconds + (i < decimals.size() ? decimals[i] - '0' : 0);
  }
  return microseconds + (decimals.size() > 6 && decimals[6] >= '5' ? 1 : 0);
}

}  // namespace

std::optional<double> parse_double(std::string_view text) { return parse<double>(text); }
std::optional<std::int64_t> parse_integer(std::string_view text) { return parse<std::int64_t>(text); }

std::optional<Stamp> parse_seconds(std::string_view text) {
  if (text.find_first_of("eE") != std::string_view::npos) return parse_scientific_seconds(text);
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view decimals = point < text.size() ? text.substr(point + 1) : std::string_view{};
  if (whole.empty() && decimals.empty()) return std::nullopt;
  if (!std::ranges::all_of(whole, is_digit) || !std::ranges::all_of(decimals, is_digit)) return std::nullopt;
  const std::optional<std::int64_t> seconds = parse_whole_seconds(whole);
  if (!seconds) return std::nullopt;
  const std::int64_t microseconds = kMicrosecondsPerSecond * *seconds + rounded_microseconds(decimals);
  return stamp_from_us(negative ? -microseconds : microseconds);
}

void append_double(std::string& out, double value) { append(out, value); }
void append_integer(std::string& out, std::int64_t value) { append(out, value); }

void append_seconds(std::string& out, Stamp stamp) {
  const std::int64_t microseconds = to_us(stamp);
  if (microseconds < 0) out += '-';
  const std::int64_t magnitude = std::abs(microseconds);
  append_integer(out, magnitude / kMicrosecondsPerSecond);
  // A leading 1 keeps the zeros of the fraction, and is then replaced by the point.
  const std::size_t point = out.size();
  append_integer(out, kMicrosecondsPerSecond + magnitude % kMicrosecondsPerSecond);
  out[point] = '.';
}

}  // namespace azimuth
