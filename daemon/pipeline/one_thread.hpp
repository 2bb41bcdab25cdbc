#pragma once
#include <atomic>
#include <cassert>
#include <thread>

namespace azimuth {

/// Asserts that one end of a wire is used by one thread only: a second one would lose samples or hang. Costs nothing
/// where assertions are off.
class OneThread {
 public:
  void check() noexcept {
#ifndef NDEBUG
    const std::thread::id self = std::this_thread::get_id();
    std::thread::id expected{};
    const bool first = user_.compare_exchange_strong(expected, self, std::memory_order_relaxed);
    assert((first || expected == self) && "one thread at each end of a wire");
#endif
  }

 private:
#ifndef NDEBUG
  std::atomic<std::thread::id> user_{};
#endif
};

}  // namespace azimuth
