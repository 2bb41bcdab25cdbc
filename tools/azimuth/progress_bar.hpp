#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "base/progress.hpp"

namespace azimuth {

/// Returns a line with the share that is done and the time left at this pace. `what` names the counted things.
std::string progress_text(const std::string& what, std::size_t done, std::size_t all, double elapsed_s);

/// A bar on standard error that shows up only for work that takes long, and only on a terminal.
///
/// Thread contract: thread-bound.
class ProgressBar {
 public:
  /// `what` names the counted things, e.g. "images"; empty: no name.
  explicit ProgressBar(bool wanted, std::string what = {});
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar if it is due. Cheap enough to be called for every step.
  void update(std::size_t done, std::size_t all);
  /// Returns a listener that updates the bar. It borrows the bar.
  Progress listener() {
    return [this](std::size_t done, std::size_t all) { update(done, all); };
  }
  /// Erases the bar, which leaves an empty line for the next output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool shown_ = false;
  bool enabled_;
  Clock::time_point began_, next_draw_;
};

}  // namespace azimuth
