#include "settings/toml_bounds.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "settings/file_text.hpp"

namespace azimuth {
namespace {

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

}  // namespace

std::optional<FileError> beyond_toml_bounds(std::string_view text, const std::string& file) {
  if (text.size() > kLargestSettings)
    return FileError{file, 0,
                     fmt::format("is larger than {} kB, which no rig or configuration is", kLargestSettings / 1024)};
  const int line = LevelCounter(text).too_deep();
  if (line == 0) return std::nullopt;
  return FileError{file, line, fmt::format("is deeper than {} levels, which no setting is", kMostTomlLevels)};
}

}  // namespace azimuth
