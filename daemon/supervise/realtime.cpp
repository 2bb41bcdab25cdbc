#include "daemon/supervise/realtime.hpp"

#include <cerrno>
#include <cstddef>
#include <fmt/format.h>
#include <pthread.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace azimuth {
namespace {

constexpr std::size_t kThreadStack_bytes = 1 << 20;

}  // namespace

void limit_thread_stacks() {
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return;
  if (pthread_attr_setstacksize(&attributes, kThreadStack_bytes) == 0) pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

std::optional<std::string> lock_memory() {
  // Under a finite limit the call may succeed and every later allocation fail, which is worse than not locking.
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && geteuid() != 0;
  if (limited) {
    return fmt::format("memory is not locked: the limit is {} kB; set LimitMEMLOCK=infinity in the unit",
                       limit.rlim_cur / 1024);
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return std::nullopt;
  return fmt::format("memory is not locked: mlockall: {}", std::generic_category().message(errno));
}

void unlock_memory() { munlockall(); }

std::vector<std::string> refusals(const StageThread& stage) {
  const StageSpec& spec = stage.spec();
  std::vector<std::string> sentences;
  if (const int error = stage.priority_refused()) {
    sentences.push_back(fmt::format("{}: SCHED_FIFO priority {} refused: {}; set LimitRTPRIO in the unit", spec.name,
                                    spec.fifo_priority, std::generic_category().message(error)));
  }
  if (const int error = stage.cpu_refused()) {
    sentences.push_back(
        fmt::format("{}: CPU {} refused: {}", spec.name, spec.cpu, std::generic_category().message(error)));
  }
  return sentences;
}

RealTime real_time(const std::vector<StageThread*>& stages, bool lock_asked,
                   const std::optional<std::string>& lock_refusal) {
  RealTime outcome;
  bool any_fifo = false, any_cpu = false;
  for (const StageThread* stage : stages) {
    any_fifo = any_fifo || (stage->spec().fifo_priority > 0 && stage->priority_refused() == 0);
    any_cpu = any_cpu || (stage->spec().cpu >= 0 && stage->cpu_refused() == 0);
    for (std::string& refusal : refusals(*stage)) outcome.refusals.push_back(std::move(refusal));
  }
  if (lock_refusal) outcome.refusals.push_back(*lock_refusal);
  const auto add = [&outcome](bool is_so, std::string_view words) {
    if (is_so) outcome.text.append(outcome.text.empty() ? "" : ", ").append(words);
  };
  add(any_fifo, "SCHED_FIFO");
  add(any_cpu, "CPUs assigned");
  add(lock_asked && !lock_refusal, "memory locked");
  for (const std::string& refusal : outcome.refusals)
    outcome.text.append(outcome.text.empty() ? "" : "; ").append(refusal);
  return outcome;
}

}  // namespace azimuth
