#pragma once

namespace azimuth {

/// How one stage's thread is scheduled.
struct StageScheduling {
  int fifo_priority = 0;  ///< SCHED_FIFO; 0: normal scheduling
  int cpu = -1;           ///< the only CPU it may run on; -1: any
};

struct ThreadSettings {
  StageScheduling source;  ///< of every source's thread
  StageScheduling perception, estimator, publisher, recorder;
  int deadline_ms = 2000;  ///< a stage whose turn takes longer counts as hung: the watchdog is no longer fed
};

}  // namespace azimuth
