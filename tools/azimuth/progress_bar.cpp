#include "tools/azimuth/progress_bar.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr auto kLong = 500ms;  // work shorter than this shows no bar
constexpr auto kRefresh = 100ms;
constexpr std::size_t kCells = 30;

/// Rounds up, so that the text never says that no time is left before the end.
std::string time_left(double left_s) {
  const double whole_s = std::ceil(left_s);
  if (whole_s < 100.0) return fmt::format("{:.0f} s left", whole_s);
  const double whole_min = std::ceil(left_s / 60.0);
  if (whole_min < 100.0) return fmt::format("{:.0f} min left", whole_min);
  return fmt::format("{:.1f} h left", left_s / 3600.0);
}

}  // namespace

std::string progress_text(const std::string& what, std::size_t done, std::size_t all, double elapsed_s) {
  const std::size_t counted = std::min(done, all);
  const double share = all == 0 ? 0.0 : static_cast<double>(counted) / static_cast<double>(all);
  const auto full = static_cast<std::size_t>(share * kCells);
  std::string text = fmt::format("[{:#>{}}{:.>{}}] {:3.0f} %  {} of {}{}{}", "", full, "", kCells - full,
                                 std::floor(100.0 * share), counted, all, what.empty() ? "" : " ", what);
  if (counted == all) return text + ", finishing";
  return counted == 0 ? text : text + ", " + time_left(elapsed_s * (1.0 - share) / share);
}

ProgressBar::ProgressBar(bool wanted, std::string what)
    : what_(std::move(what)),
      enabled_(wanted && isatty(STDERR_FILENO) == 1),
      began_(Clock::now()),
      next_draw_(began_ + kLong) {}

void ProgressBar::update(std::size_t done, std::size_t all) {
  if (!enabled_ || all == 0) return;
  const Clock::time_point now = Clock::now();
  if (now < next_draw_ && !(shown_ && done >= all)) return;
  next_draw_ = now + kRefresh;
  shown_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - began_).count();
  std::fputs(("\r\x1b[2K" + progress_text(what_, done, all, elapsed_s)).c_str(), stderr);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[2K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace azimuth
