#pragma once
#include <atomic>
#include <thread>
#include <vector>

#include "slam/hypotheses/workers.hpp"

namespace azimuth {

/// Workers on `threads` threads, which are created for each call.
class ThreadedWorkers final : public Workers {
 public:
  explicit ThreadedWorkers(int threads) : threads_(threads) {}
  void for_each(std::size_t count, const std::function<void(std::size_t)>& task) override {
    std::atomic<std::size_t> next{0};
    std::vector<std::jthread> threads;
    for (int i = 0; i < threads_; ++i)
      threads.emplace_back([&] {
        for (std::size_t at = next++; at < count; at = next++) task(at);
      });
  }

 private:
  int threads_;
};

}  // namespace azimuth
