#pragma once
#include <cstddef>
#include <functional>

namespace azimuth {

/// Interface for running tasks in parallel. Threads are created by its implementations outside this library.
class Workers {
 public:
  virtual ~Workers() = default;
  /// Calls `task` with 0 to count - 1, each once, in any order and on any threads, and returns when all are done.
  virtual void for_each(std::size_t count, const std::function<void(std::size_t)>& task) = 0;
};

/// Runs the tasks one after the other on the calling thread.
class InTurn final : public Workers {
 public:
  void for_each(std::size_t count, const std::function<void(std::size_t)>& task) override {
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
};

}  // namespace azimuth
