#include "settings/toml_bounds.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "settings/file_text.hpp"

namespace azimuth {
namespace {

/// Goes over TOML as far as texts, comments, dots and brackets are concerned. On all that is valid it agrees with the
/// library to the letter, and what comes after a mistake the library does not read.
class LevelCounter {
 public:
  explicit LevelCounter(std::string_view text) : rest_(text) {}

  /// The line of the first place that is too deep; 0: none is.
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

  /// A text that its line does not end is a mistake, after which the library goes on with the next line.
  void skip_line_text(char quote) {
    const std::size_t line_end = std::min(rest_.find('\n'), rest_.size());
    std::size_t at = 1;
    while (at < line_end && rest_[at] != quote) at += is_escape(at, quote) ? 2 : 1;
    skip(std::min(at + 1, line_end));
  }

  /// Up to five quotes end it: two may be its own.
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
  int dots_ = 0;  // of the key
  int open_ = 0;  // brackets
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
