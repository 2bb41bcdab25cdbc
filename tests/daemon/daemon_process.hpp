#pragma once
// Runs the daemon as a process, with a service manager that it notifies.

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "tests/daemon/child_process.hpp"
#include "tests/daemon/notify_socket.hpp"
#include "tests/daemon/run_files.hpp"

namespace azimuth::test {

/// All files of the daemon are in a temporary folder, and its LCM messages stay inside its process.
class DaemonProcess : public ::testing::Test {
 protected:
  using Daemon = std::unique_ptr<ChildProcess>;

  /// Starts `program` with `options`, followed by `more`. `variables` are added to its environment.
  Daemon start_program(const std::string& program, const std::vector<std::string>& options,
                       const std::vector<std::string>& more, std::vector<std::string> variables = {}) const {
    std::vector<std::string> command{program, "--lcm-url", "memq://"};
    command.insert(command.end(), options.begin(), options.end());
    command.insert(command.end(), more.begin(), more.end());
    variables.push_back(socket_.variable());
    return std::make_unique<ChildProcess>(command, folder_.path(), variables);
  }
  /// Writes the small run of the given duration and returns its folder.
  std::string write_small_run(double duration_s) const {
    return write_run(small_recording(duration_s), folder_.path() / "run").string();
  }
  /// Whether the daemon logs `words` within a minute.
  static bool says(const ChildProcess& daemon, const std::string& words) {
    return eventually([&] { return daemon.standard_error().find(words) != std::string::npos; },
                      std::chrono::seconds(60));
  }

  TemporaryFolder folder_;
  NotifySocket socket_{folder_.path()};
};

}  // namespace azimuth::test
