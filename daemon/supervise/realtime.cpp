#include "daemon/supervise/realtime.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace azimuth {

std::string lock_memory() {
  // Under a finite limit the call may succeed and every later allocation fail; that is worse than not locking.
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && geteuid() != 0;
  if (limited) {
    return fmt::format("memory is not locked: the limit is {} kB; set LimitMEMLOCK=infinity in the unit",
                       limit.rlim_cur / 1024);
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return fmt::format("memory is not locked: mlockall: {}", std::generic_category().message(errno));
}

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

}  // namespace azimuth
