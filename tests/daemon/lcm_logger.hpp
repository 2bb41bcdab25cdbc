#pragma once
// The real lcm-logger, in the network namespace of the test.

#include <filesystem>

#include "tests/daemon/child_process.hpp"

namespace azimuth::test {

/// One that records all channels into `log` from hears() on.
class LcmLogger {
 public:
  static constexpr const char* kProbe = "PROBE";  ///< channel of the messages that hears() sends

  /// `folder` receives its output.
  LcmLogger(std::filesystem::path log, const std::filesystem::path& folder);

  /// Sends probes until the logger has written one: from then on it hears everything. A failure when it never does.
  bool hears();
  /// Waits until it has written what it heard, and ends it.
  void finish();

 private:
  std::filesystem::path log_;
  ChildProcess process_;
};

}  // namespace azimuth::test
