#pragma once

namespace azimuth {

/// While one lives, Ctrl-C and SIGTERM are noted, so that what is half written can go; the next one ends the program at
/// once. Not two at a time.
///
/// Thread contract: of the only thread.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Throws what ends the program with kInterrupted, once it was asked to end.
  static void check();
};

}  // namespace azimuth
