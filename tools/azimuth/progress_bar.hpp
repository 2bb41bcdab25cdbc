#pragma once
#include <chrono>
#include <cstddef>

namespace azimuth {

/// A bar on standard error that shows up only for work that takes long, and only on a terminal.
///
/// Thread contract: thread-bound.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Cheap enough to be called for every step.
  void update(std::size_t done, std::size_t all);
  /// Leaves an empty line for what is printed next.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::size_t done, std::size_t all) const;

  bool shown_ = false;
  bool enabled_;
  Clock::time_point next_draw_;
};

}  // namespace azimuth
