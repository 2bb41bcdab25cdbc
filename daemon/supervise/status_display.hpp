#pragma once
#include <string>

namespace azimuth {

/// The status line on standard error: rewritten in place on a terminal, one line each otherwise.
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
