#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "daemon/pipeline/doorbell.hpp"

namespace azimuth {

struct StageSpec {
  const char* name;                    ///< at most 15 characters, as shown by `top -H`
  int fifo_priority = 0;               ///< SCHED_FIFO; 0: normal scheduling
  int cpu = -1;                        ///< the only CPU that the thread may run on; -1: any
  std::chrono::milliseconds deadline;  ///< longest allowed time between two heartbeats
  int nice = 0;                        ///< nice value under normal scheduling; threads with lower values go first
};

/// A named thread that repeats its turn until it is stopped. It records a heartbeat after each turn, and the supervisor
/// compares the age of the heartbeat with the deadline.
///
/// Thread contract: start(), stop() and the destructor belong to one thread; any thread may call late() and the
/// functions for refusals.
class StageThread {
 public:
  /// `turn` does one bounded piece of work, or sleeps on `wake` while there is none, and returns within the deadline.
  /// After stop() the turn runs once more, to drain what has arrived.
  StageThread(StageSpec spec, Doorbell& wake, std::function<void()> turn);
  ~StageThread() { stop(); }
  StageThread(const StageThread&) = delete;
  StageThread& operator=(const StageThread&) = delete;

  /// Starts the thread once; a stopped stage cannot be started again. Throws std::system_error when the system refuses
  /// a thread.
  void start();
  /// Waits for the current turn and the last one. Does nothing when the thread is not running.
  void stop();

  /// True: the last heartbeat is older than the deadline. A stage that does not run is never late.
  bool late(std::chrono::steady_clock::time_point now) const;

  const StageSpec& spec() const { return spec_; }

  /// The errno with which the system refused a part of the spec; 0: not refused. Valid once the first turn has begun.
  int priority_refused() const { return priority_refused_.load(std::memory_order_acquire); }
  int cpu_refused() const { return cpu_refused_.load(std::memory_order_acquire); }

 private:
  void run(const std::stop_token& stop);
  void apply_spec();
  void beat();

  StageSpec spec_;
  Doorbell& wake_;
  std::function<void()> turn_;
  std::atomic<std::int64_t> last_beat_ns_{0};
  std::atomic<bool> running_{false};
  std::atomic<int> priority_refused_{0}, cpu_refused_{0};
  std::jthread thread_;
};

}  // namespace azimuth
