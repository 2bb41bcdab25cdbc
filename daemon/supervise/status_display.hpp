#pragma once
#include <cstddef>
#include <string>

namespace azimuth {

/// Shortens a text to one line of a terminal with `columns` columns. The last column stays empty, because a terminal
/// may wrap there. A shortened text ends in "...". Control characters become blanks. UTF-8 characters are not split,
/// and each counts as one column. 0 columns: the width is unknown and nothing is cut.
std::string one_line_of(const std::string& text, std::size_t columns);

/// The status line on standard error. On a terminal it is rewritten in place and cut to the current width; otherwise
/// every status is a line of its own.
///
/// Thread contract: thread-bound.
class StatusDisplay {
 public:
  /// `wanted`: show the status even if standard error is not a terminal.
  explicit StatusDisplay(bool wanted);
  ~StatusDisplay() { end_line(); }
  StatusDisplay(const StatusDisplay&) = delete;
  StatusDisplay& operator=(const StatusDisplay&) = delete;

  void show(const std::string& line);
  /// True: there was a terminal at construction, and it no longer exists.
  bool terminal_is_gone() const;
  /// To be called before anything else is written to the terminal.
  void end_line();

 private:
  bool terminal_, shown_;
  bool line_open_ = false;
};

}  // namespace azimuth
