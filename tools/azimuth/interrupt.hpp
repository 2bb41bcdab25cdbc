#pragma once

namespace azimuth {

/// While an object of this class lives, the first Ctrl-C or SIGTERM is only noted, so that half-written output can be
/// removed. The next signal ends the program at once. At most one object may live at a time.
///
/// Thread contract: for single-threaded programs.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Throws CommandError with kInterrupted once a signal was noted.
  static void check();
};

}  // namespace azimuth
