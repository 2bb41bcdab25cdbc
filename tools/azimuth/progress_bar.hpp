#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "base/progress.hpp"

namespace azimuth {

/// A line that says how much is done and how long the rest will take at this pace. `what`: of what there are so many.
std::string progress_text(const std::string& what, std::size_t done, std::size_t all, double elapsed_s);

/// A bar on standard error that shows up only for work that takes long, and only on a terminal.
///
/// Thread contract: thread-bound.
class ProgressBar {
 public:
  /// `what` is counted, e.g. "images"; empty: it has no name.
  explicit ProgressBar(bool wanted, std::string what = {});
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Cheap enough to be called for every step.
  void update(std::size_t done, std::size_t all);
  /// For who does the work. Borrows the bar.
  Progress listener() {
    return [this](std::size_t done, std::size_t all) { update(done, all); };
  }
  /// Leaves an empty line for what is printed next.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool shown_ = false;
  bool enabled_;
  Clock::time_point began_, next_draw_;
};

}  // namespace azimuth
