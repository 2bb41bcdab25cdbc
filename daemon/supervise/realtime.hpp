#pragma once
#include <optional>
#include <string>
#include <vector>

#include "daemon/pipeline/stage_thread.hpp"

namespace azimuth {

/// Gives threads that are created from now on 1 MB of stack each, where the system's default is 8. Locked memory is
/// populated when it is mapped, and filling a dozen default stacks with zeros took most of a restart's time.
void limit_thread_stacks();

/// Locks the process into memory, now and for what it will allocate; thread stacks are populated as they are made.
/// Why not; nothing when it is locked.
std::optional<std::string> lock_memory();

/// Lets go of what lock_memory() locked.
void unlock_memory();

/// What the system refused of the threads' scheduling, one sentence each.
std::vector<std::string> refusals(const StageThread& stage);

/// What became of a wish for real time.
struct RealTime {
  std::string text;                   ///< in words, for the status; empty: nothing was asked for
  std::vector<std::string> refusals;  ///< one sentence each
};

/// Of the threads, each of which has begun its first turn, and of the memory lock: whether it was asked for, and what
/// lock_memory() returned.
RealTime real_time(const std::vector<StageThread*>& stages, bool lock_asked,
                   const std::optional<std::string>& lock_refusal);

}  // namespace azimuth
