#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "slam/hindsight/errand.hpp"
#include "slam/hypotheses/workers.hpp"

namespace azimuth {

/// An errand's work on a thread of its own, under normal scheduling: what the estimator waits for at last is never in
/// the way of what it must answer at once.
///
/// Thread contract: thread-bound; the work runs on the thread it owns. What is under way is finished before it ends.
class ErrandThread final : public Errand {
 public:
  ErrandThread();
  ~ErrandThread() override;
  ErrandThread(const ErrandThread&) = delete;
  ErrandThread& operator=(const ErrandThread&) = delete;

  void begin(std::function<void()> work) override;
  void finish() override;

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::function<void()> work_;  // empty: none is under way
  std::jthread thread_;
};

/// Work that may be done side by side, on the thread that asks and on others.
///
/// Thread contract: as ErrandThread.
class WorkerThreads final : public Workers {
 public:
  /// On so many in all, at least 1.
  explicit WorkerThreads(int threads);
  ~WorkerThreads() override;
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  void for_each(std::size_t count, const std::function<void(std::size_t)>& task) override;

 private:
  void run(const std::stop_token& stop);
  void do_some();

  std::mutex mutex_;
  std::condition_variable_any changed_;
  const std::function<void(std::size_t)>* task_ = nullptr;  // borrowed while one is under way
  std::size_t count_ = 0, round_ = 0, at_work_ = 0;
  std::atomic<std::size_t> next_{0};
  std::vector<std::jthread> threads_;
};

}  // namespace azimuth
