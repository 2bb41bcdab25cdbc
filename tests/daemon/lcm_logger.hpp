#pragma once
// Runs the real lcm-logger in the network namespace of the test.

#include <filesystem>

#include "tests/daemon/child_process.hpp"

namespace azimuth::test {

/// An lcm-logger that records all channels into `log`, complete from hears() on.
class LcmLogger {
 public:
  static constexpr const char* kProbe = "PROBE";  ///< Channel of the messages that hears() sends

  /// `folder` receives the program's output.
  LcmLogger(std::filesystem::path log, const std::filesystem::path& folder);

  /// Sends probes until the logger has written one; from then on the logger receives every message. Adds a test failure
  /// if no probe is written in time.
  bool hears();
  /// Waits until the logger has written all messages, and ends it.
  void finish();

 private:
  std::filesystem::path log_;
  ChildProcess process_;
};

}  // namespace azimuth::test
