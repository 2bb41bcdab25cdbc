#include "settings/toml_text.hpp"

#include <algorithm>

#include "settings/toml_bounds.hpp"

namespace azimuth {
namespace {

constexpr int kMaxSyntaxErrors = 20;

/// Start and length of a line without its line end; a length of 0 if there is no such line.
struct LineSpan {
  std::size_t start = 0, length = 0;
};

LineSpan find_line(std::string_view text, unsigned line) {
  std::size_t start = 0;
  for (unsigned i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string_view::npos) return {};
    start = end + 1;
  }
  return {start, std::min(text.find('\n', start), text.size()) - start};
}

/// Whether the line holds a whole `key = value`, so that it can be left out without damage to other lines.
bool is_assignment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos || line[first] == '[' || line[first] == '#') return false;
  return line.find('=') != std::string_view::npos &&
         std::count(line.begin(), line.end(), '[') == std::count(line.begin(), line.end(), ']');
}

/// Whether the TOML contains a text over several lines, which may hold lines that look like keys.
bool has_long_text(std::string_view text) {
  return text.find("\"\"\"") != std::string_view::npos || text.find("'''") != std::string_view::npos;
}

/// Parses the text. Adds a syntax error to `parsed` and returns its line; returns 0 on success.
unsigned try_parse(std::string_view text, const std::string& file, ParsedToml& parsed) {
  try {
    parsed.root = toml::parse(text);
    return 0;
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    parsed.violations.push_back(
        {file, static_cast<int>(at.line), std::string(error.description()), static_cast<int>(at.column)});
    return std::max(at.line, 1U);
  }
}

}  // namespace

ParsedToml parse_toml(std::string_view text, const std::string& file) {
  ParsedToml parsed;
  if (auto beyond = beyond_toml_bounds(text, file)) {
    parsed.violations.push_back(*std::move(beyond));
    parsed.complete = false;
    return parsed;
  }
  std::string remaining(text);
  for (int i = 0; i < kMaxSyntaxErrors; ++i) {
    const unsigned bad_line = try_parse(remaining, file, parsed);
    if (bad_line == 0) return parsed;
    if (has_long_text(remaining)) break;
    const LineSpan line = find_line(remaining, bad_line);
    if (!is_assignment(std::string_view(remaining).substr(line.start, line.length))) break;
    // Blanks keep the line numbers and columns of everything else.
    std::fill_n(remaining.begin() + static_cast<std::ptrdiff_t>(line.start), line.length, ' ');
  }
  parsed.complete = false;
  return parsed;
}

}  // namespace azimuth
