#include "drivers/can/dbc_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace azimuth {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

/// Parses a number at the beginning of `text`. Returns its number of characters; 0: there is none.
template <class Number>
std::size_t parse(std::string_view text, Number& number) {
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
  return wrong == std::errc{} ? static_cast<std::size_t>(end - text.data()) : 0;
}

}  // namespace

void DbcText::skip_blanks() {
  while (!rest_.empty() && is_blank(rest_.front())) drop(1);
}

void DbcText::skip_space() {
  for (; !rest_.empty() && (is_blank(rest_.front()) || rest_.front() == '\n'); drop(1)) line_ += rest_.front() == '\n';
}

bool DbcText::skip_statement_line() {
  bool in_string = false;
  while (!rest_.empty()) {
    const char c = rest_.front();
    drop(1);
    if (in_string && c == '\\' && rest_.starts_with('"')) {
      drop(1);
      continue;
    }
    if (c == '"') in_string = !in_string;
    if (c != '\n') continue;
    ++line_;
    if (!in_string) return true;
  }
  return !in_string;
}

std::string_view DbcText::word() {
  skip_blanks();
  const auto end = std::ranges::find_if_not(rest_, is_word);
  const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
  drop(word.size());
  return word;
}

bool DbcText::take(char c) {
  skip_blanks();
  if (rest_.empty() || rest_.front() != c) return false;
  drop(1);
  return true;
}

std::optional<std::uint64_t> DbcText::natural() {
  skip_blanks();
  std::uint64_t number = 0;
  const std::size_t used = parse(rest_, number);
  if (used == 0) return std::nullopt;
  drop(used);
  return number;
}

std::optional<double> DbcText::number() {
  skip_blanks();
  const std::string_view unsigned_text = rest_.starts_with('+') ? rest_.substr(1) : rest_;
  double number = 0.0;
  const std::size_t used = parse(unsigned_text, number);
  if (used == 0 || !std::isfinite(number)) return std::nullopt;
  drop(used + (rest_.size() - unsigned_text.size()));
  return number;
}

}  // namespace azimuth
