#include "daemon/pipeline/stage_thread.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace azimuth {

StageThread::StageThread(StageSpec spec, Doorbell& wake, std::function<void()> turn)
    : spec_(spec), wake_(wake), turn_(std::move(turn)) {}

void StageThread::start() {
  beat();
  running_.store(true, std::memory_order_release);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void StageThread::stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  wake_.ring();
  thread_.join();
  running_.store(false, std::memory_order_release);
}

bool StageThread::late(std::chrono::steady_clock::time_point now) const {
  if (!running_.load(std::memory_order_acquire)) return false;
  const std::chrono::nanoseconds last_beat(last_beat_ns_.load(std::memory_order_relaxed));
  return now.time_since_epoch() - last_beat > spec_.deadline;
}

void StageThread::run(const std::stop_token& stop) {
  apply_spec();
  while (!stop.stop_requested()) {
    turn_();
    beat();
  }
  wake_.ring();  // so that the last turn does not sleep
  turn_();
}

void StageThread::apply_spec() {
  pthread_setname_np(pthread_self(), spec_.name);
  if (spec_.cpu >= 0) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    CPU_SET(static_cast<std::size_t>(spec_.cpu), &cpus);
    cpu_refused_.store(pthread_setaffinity_np(pthread_self(), sizeof cpus, &cpus), std::memory_order_release);
  }
  // On Linux, the nice value applies to this thread only. Raising it is never refused.
  if (spec_.nice > 0) static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), spec_.nice));
  if (spec_.fifo_priority > 0) {
    const sched_param parameters{.sched_priority = spec_.fifo_priority};
    priority_refused_.store(pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters), std::memory_order_release);
  }
}

void StageThread::beat() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  last_beat_ns_.store(std::chrono::nanoseconds(now).count(), std::memory_order_relaxed);
}

}  // namespace azimuth
