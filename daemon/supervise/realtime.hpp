#pragma once
#include <optional>
#include <string>
#include <vector>

#include "daemon/pipeline/stage_thread.hpp"

namespace azimuth {

/// Limits the stack of every thread created from now on to 1 MB; the system's default is 8 MB. Locked memory is
/// populated when it is mapped, and filling a dozen default stacks with zeros would take most of the time of a restart.
void limit_thread_stacks();

/// Locks the memory of the process, present and future; thread stacks are populated when they are created. Returns why
/// it failed; none: the memory is locked.
std::optional<std::string> lock_memory();

/// Unlocks the memory that lock_memory() locked.
void unlock_memory();

/// The scheduling requests that the system refused for the thread of `stage`, one sentence each.
std::vector<std::string> refusals(const StageThread& stage);

/// The result of the requests for real-time behaviour.
struct RealTime {
  std::string text;                   ///< in words, for the status; empty: nothing was requested
  std::vector<std::string> refusals;  ///< refused requests, one sentence each
};

/// Collects the results of the threads' scheduling and of the memory lock. Each thread must have begun its first turn.
/// `lock_asked`: the lock was requested; `lock_refusal`: the result of lock_memory().
RealTime real_time(const std::vector<StageThread*>& stages, bool lock_asked,
                   const std::optional<std::string>& lock_refusal);

}  // namespace azimuth
