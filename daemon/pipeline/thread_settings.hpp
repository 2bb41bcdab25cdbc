#pragma once

namespace azimuth {

/// Scheduling of one stage's thread.
struct StageScheduling {
  int fifo_priority = 0;  ///< SCHED_FIFO; 0: normal scheduling
  int cpu = -1;           ///< the only CPU that the thread may run on; -1: any
};

struct ThreadSettings {
  StageScheduling source;  ///< for the thread of every source
  StageScheduling perception, estimator, publisher, recorder;
  /// A stage whose turn takes longer than this counts as hung: the watchdog is no longer fed.
  int deadline_ms = 2000;
};

}  // namespace azimuth
