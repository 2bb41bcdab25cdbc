#include "daemon/supervise/status_display.hpp"

#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/visible.hpp"

namespace azimuth {
namespace {

/// 0: the width is unknown.
std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0U;
}

bool goes_on(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Number of bytes of the first `characters` characters.
std::size_t bytes_of(const std::string& text, std::size_t characters) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if (!goes_on(text[at]) && characters-- == 0) break;
  return at;
}

}  // namespace

std::string one_line_of(const std::string& text, std::size_t columns) {
  constexpr std::size_t kDots = 3;
  const std::string line = visible(text);
  if (columns == 0 || bytes_of(line, columns - 1) == line.size()) return line;
  if (columns <= kDots) return line.substr(0, bytes_of(line, columns - 1));
  return line.substr(0, bytes_of(line, columns - 1 - kDots)) + "...";
}

StatusDisplay::StatusDisplay(bool wanted) : terminal_(isatty(STDERR_FILENO) == 1), shown_(wanted || terminal_) {}

void StatusDisplay::show(const std::string& line) {
  if (!shown_) return;
  if (terminal_) {
    const std::string seen = one_line_of(line, terminal_columns());
    std::fprintf(stderr, "\r%s\x1b[K", seen.c_str());  // and erase the rest of the previous line
    line_open_ = true;
  } else {
    std::fprintf(stderr, "%s\n", visible(line).c_str());
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
