#pragma once
#include <ctime>

namespace azimuth {

/// CPU time of the calling thread; with CLOCK_PROCESS_CPUTIME_ID, CPU time of all threads.
inline double cpu_time_s(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace azimuth
