#include "tools/azimuth/progress_bar.hpp"

#include <cstdio>
#include <string>
#include <unistd.h>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr auto kLong = 500ms;  // before the bar is worth a line
constexpr auto kRefresh = 100ms;
constexpr std::size_t kCells = 40;

}  // namespace

ProgressBar::ProgressBar(bool wanted)
    : enabled_(wanted && isatty(STDERR_FILENO) == 1), next_draw_(Clock::now() + kLong) {}

void ProgressBar::update(std::size_t done, std::size_t all) {
  if (!enabled_ || all == 0) return;
  const Clock::time_point now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + kRefresh;
  shown_ = true;
  draw(done, all);
}

void ProgressBar::draw(std::size_t done, std::size_t all) const {
  const std::size_t full = kCells * done / all;
  const std::string bar = std::string(full, '#') + std::string(kCells - full, '.');
  std::fprintf(stderr, "\r[%s] %3zu %%  %zu of %zu", bar.c_str(), 100 * done / all, done, all);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[2K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace azimuth
