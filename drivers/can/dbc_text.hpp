#pragma once
// Internal to drivers/can.

#include <cstdint>
#include <optional>
#include <string_view>

namespace azimuth {

/// The text of a DBC file, taken from the front. What is not there is not taken. Blanks before a thing are passed over,
/// ends of lines are not: a statement that is cut short must not go on in the next line.
///
/// Thread contract: thread-bound; never allocates.
class DbcText {
 public:
  DbcText(std::string_view text, int line) : rest_(text), line_(line) {}

  bool at_end() const { return rest_.empty(); }
  int line() const { return line_; }

  void skip_space();  ///< ends of lines as well
  /// To the next line; a string on the way may have many lines. False: one has no end.
  bool skip_statement_line();

  std::string_view word();  ///< letters, digits and '_'; empty: none
  bool take(char c);
  std::optional<std::uint64_t> natural();
  std::optional<double> number();  ///< finite

 private:
  void skip_blanks();
  void drop(std::size_t count) { rest_.remove_prefix(count); }

  std::string_view rest_;
  int line_;
};

}  // namespace azimuth
