#pragma once
#include <cstddef>
#include <string>

namespace azimuth {

/// As much of a text as stands on one line of a terminal with so many columns: its last one stays empty, since a
/// terminal may wrap there; what is cut ends in "...". Control characters become blanks. UTF-8 is not cut within a
/// character, each of which is taken to be one column wide. 0 columns: the width is not known, nothing is cut.
std::string one_line_of(const std::string& text, std::size_t columns);

/// The status line on standard error: rewritten in place on a terminal and cut to its present width, one whole line
/// each otherwise.
///
/// Thread contract: thread-bound.
class StatusDisplay {
 public:
  /// `wanted`: also where standard error is not a terminal.
  explicit StatusDisplay(bool wanted);
  ~StatusDisplay() { end_line(); }
  StatusDisplay(const StatusDisplay&) = delete;
  StatusDisplay& operator=(const StatusDisplay&) = delete;

  void show(const std::string& line);
  /// There was a terminal when this was made, and it is gone.
  bool terminal_is_gone() const;
  /// Before anything else is written to the terminal.
  void end_line();

 private:
  bool terminal_, shown_;
  bool line_open_ = false;
};

}  // namespace azimuth
