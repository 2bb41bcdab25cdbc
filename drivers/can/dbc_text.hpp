#pragma once
// Internal to drivers/can.

#include <cstdint>
#include <optional>
#include <string_view>

namespace azimuth {

/// The text of a DBC file, consumed from its beginning. A function that does not find its element consumes nothing.
/// Blanks before an element are skipped, but not line ends, because a truncated statement must not continue in the next
/// line.
///
/// Thread contract: thread-bound; never allocates.
class DbcText {
 public:
  DbcText(std::string_view text, int line) : rest_(text), line_(line) {}

  bool at_end() const { return rest_.empty(); }
  int line() const { return line_; }

  void skip_space();  ///< skips line ends as well
  /// Skips to the next line; a string on the way may span several lines. False: a string has no end.
  bool skip_statement_line();

  std::string_view word();  ///< letters, digits and '_'; empty: none
  bool take(char c);
  std::optional<std::uint64_t> natural();
  std::optional<double> number();  ///< a finite number; none: there is none

 private:
  void skip_blanks();
  void drop(std::size_t count) { rest_.remove_prefix(count); }

  std::string_view rest_;
  int line_;
};

}  // namespace azimuth
