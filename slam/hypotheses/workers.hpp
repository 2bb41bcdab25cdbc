#pragma once
#include <cstddef>
#include <functional>

namespace azimuth {

/// Who does work that may be done side by side. Threads are made elsewhere: here there are none.
class Workers {
 public:
  virtual ~Workers() = default;
  /// Calls `task` with 0 to count - 1, each once, in any order and on any threads, and returns when all are done.
  virtual void for_each(std::size_t count, const std::function<void(std::size_t)>& task) = 0;
};

/// One after the other, on the thread that asks.
class InTurn final : public Workers {
 public:
  void for_each(std::size_t count, const std::function<void(std::size_t)>& task) override {
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
};

}  // namespace azimuth
