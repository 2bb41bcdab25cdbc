#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "slam/hindsight/task_runner.hpp"
#include "slam/hypotheses/workers.hpp"

namespace azimuth {

/// Runs the work of a TaskRunner on a thread of its own, under normal scheduling. So a long computation does not delay
/// the estimates that are due at once.
///
/// Thread contract: thread-bound; only the work runs on the thread that this object owns. The destructor waits until
/// the current work is finished.
class TaskThread final : public TaskRunner {
 public:
  TaskThread();
  ~TaskThread() override;
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  void begin(std::function<void()> work) override;
  void finish() override;

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::function<void()> work_;  // empty: no work in progress
  std::jthread thread_;
};

/// Runs independent tasks in parallel, on the calling thread and on worker threads.
///
/// Thread contract: as TaskThread.
class WorkerThreads final : public Workers {
 public:
  /// Uses `threads` threads in all, including the caller's; at least 1.
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
  const std::function<void(std::size_t)>* task_ = nullptr;  // borrowed during for_each()
  std::size_t count_ = 0, round_ = 0, at_work_ = 0;
  std::atomic<std::size_t> next_{0};
  std::vector<std::jthread> threads_;
};

}  // namespace azimuth
