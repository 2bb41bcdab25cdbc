#pragma once
#include <string>
#include <vector>

#include "daemon/pipeline/stage_thread.hpp"

namespace azimuth {

/// Locks the process into memory, now and for what it will allocate. Returns why not, empty when it is locked.
std::string lock_memory();

/// What the system refused of the threads' scheduling, one sentence each.
std::vector<std::string> refusals(const StageThread& stage);

}  // namespace azimuth
