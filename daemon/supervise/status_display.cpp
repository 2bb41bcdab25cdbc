#include "daemon/supervise/status_display.hpp"

#include <cstdio>
#include <unistd.h>

namespace azimuth {

StatusDisplay::StatusDisplay(bool wanted) : terminal_(isatty(STDERR_FILENO) == 1), shown_(wanted || terminal_) {}

void StatusDisplay::show(const std::string& line) {
  if (!shown_) return;
  if (terminal_) {
    std::fprintf(stderr, "\r%s\x1b[K", line.c_str());  // and erase what the last line had more
    line_open_ = true;
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
  std::fflush(stderr);
}

bool StatusDisplay::terminal_is_gone() const { return terminal_ && isatty(STDERR_FILENO) != 1; }

void StatusDisplay::end_line() {
  if (!line_open_) return;
  std::fputc('\n', stderr);
  line_open_ = false;
}

}  // namespace azimuth
