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
  const char* name;                    ///< at most 15 characters, as `top -H` shows it
  int fifo_priority = 0;               ///< SCHED_FIFO; 0: normal scheduling
  int cpu = -1;                        ///< the only CPU it may run on; -1: any
  std::chrono::milliseconds deadline;  ///< longest honest time between two beats
  int nice = 0;                        ///< under normal scheduling, how readily it gives way
};

/// One named thread that takes turns until it is stopped. It beats once a turn; the supervisor compares the beats with
/// the deadline.
///
/// Thread contract: start(), stop() and the destructor belong to one thread; late() and refusals may be asked by any.
class StageThread {
 public:
  /// `turn()` does one bounded piece of work, sleeping on `wake` while there is none, and returns within the deadline.
  /// After the stop it runs once more, to drain what arrived before.
  StageThread(StageSpec spec, Doorbell& wake, std::function<void()> turn);
  ~StageThread() { stop(); }
  StageThread(const StageThread&) = delete;
  StageThread& operator=(const StageThread&) = delete;

  /// Starts once; a stopped stage stays stopped. Throws std::system_error when the system refuses a thread.
  void start();
  /// Waits for the turn at hand and the last one. Does nothing when not running.
  void stop();

  /// Whether the last beat is older than the deadline. A stage that does not run is never late.
  bool late(std::chrono::steady_clock::time_point now) const;

  const StageSpec& spec() const { return spec_; }

  /// What of the spec the system refused, as errno; 0: nothing. Known once the first turn began.
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
