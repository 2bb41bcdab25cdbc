#pragma once
#include <functional>

namespace azimuth {

/// Interface for running one task at a time in the background. Threads are created by its implementations outside this
/// library.
class TaskRunner {
 public:
  virtual ~TaskRunner() = default;
  /// Starts `work`. No other work may be running.
  virtual void begin(std::function<void()> work) = 0;
  /// Waits for the started work; returns at once when there is none.
  virtual void finish() = 0;
};

/// Runs the work on the calling thread, before begin() returns.
class AtOnce final : public TaskRunner {
 public:
  void begin(std::function<void()> work) override { work(); }
  void finish() override {}
};

}  // namespace azimuth
