#include "settings/toml_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "settings/file_text.hpp"

namespace azimuth {
namespace {

// Limits on a text before the TOML library parses it, since the library's stack grows with the levels of a key.

/// Largest number of levels of one key, and of lists and tables in values. Azimuth's own files have four levels.
constexpr int kMostTomlLevels = 32;

/// Scans TOML for texts, comments, dots and brackets only. On valid TOML the scan agrees with the library exactly. The
/// scan may differ after a syntax error, where the library stops reading.
class LevelCounter {
 public:
  explicit LevelCounter(std::string_view text) : rest_(text) {}

  /// The first line that is too deep, or 0.
  int too_deep() {
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '"' || c == '\'') {
        skip_text(c);
      } else if (c == '#') {
        skip(std::min(rest_.find('\n'), rest_.size()));
      } else {
        count(c);
        skip(1);
      }
      if (dots_ >= kMostTomlLevels || open_ > kMostTomlLevels) return line_;
    }
    return 0;
  }

 private:
  void skip(std::size_t letters) {
    line_ += static_cast<int>(std::ranges::count(rest_.substr(0, letters), '\n'));
    rest_.remove_prefix(letters);
  }

  void count(char c) {
    if (c == '.') ++dots_;
    if (c == '[' || c == '{') ++open_;
    if ((c == ']' || c == '}') && open_ > 0) --open_;
    constexpr std::string_view kEndsOfKeys = "=,\n[]{}";
    if (kEndsOfKeys.find(c) != std::string_view::npos) dots_ = 0;
  }

  void skip_text(char quote) {
    const std::string thrice(3, quote);
    rest_.starts_with(thrice) ? skip_long_text(thrice) : skip_line_text(quote);
  }

  /// Skips a text up to the closing quote or the end of the line. A text without a closing quote is a syntax error.
  void skip_line_text(char quote) {
    const std::size_t line_end = std::min(rest_.find('\n'), rest_.size());
    std::size_t at = 1;
    while (at < line_end && rest_[at] != quote) at += is_escape(at, quote) ? 2 : 1;
    skip(std::min(at + 1, line_end));
  }

  /// Skips a text in triple quotes. Up to five quotes end it, since its content may end in two quotes.
  void skip_long_text(const std::string& thrice) {
    std::size_t at = thrice.size();
    while (at < rest_.size() && !rest_.substr(at).starts_with(thrice)) at += is_escape(at, thrice[0]) ? 2 : 1;
    std::size_t end = std::min(at + thrice.size(), rest_.size());
    for (int own = 0; own < 2 && end < rest_.size() && rest_[end] == thrice[0]; ++own) ++end;
    skip(end);
  }

  bool is_escape(std::size_t at, char quote) const { return quote == '"' && rest_[at] == '\\'; }

  std::string_view rest_;
  int line_ = 1;
  int dots_ = 0;  // dots in the present key
  int open_ = 0;  // open brackets
};

/// Returns why the text must not be parsed, with the line: it is larger than kLargestSettings or deeper than
/// kMostTomlLevels. Returns nothing for a text within both limits.
std::optional<FileError> beyond_toml_bounds(std::string_view text, const std::string& file) {
  if (text.size() > kLargestSettings)
    return FileError{file, 0,
                     fmt::format("is larger than {} kB, which no rig or configuration is", kLargestSettings / 1024)};
  const int line = LevelCounter(text).too_deep();
  if (line == 0) return std::nullopt;
  return FileError{file, line, fmt::format("is deeper than {} levels, which no setting is", kMostTomlLevels)};
}

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
