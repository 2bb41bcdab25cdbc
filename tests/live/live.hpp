#pragma once
// Fixtures shared by the tests of the running daemon.

#include <gtest/gtest.h>
#include <memory>

#include "tests/live/field_log.hpp"
#include "tests/live/robot.hpp"

namespace azimuth::test {

/// azimuthd with a typical robot's options: the simulated robot's configuration and a field log.
class Daemon : public ChildProcess {
 public:
  /// The robot need not run yet. No message leaves the process unless `lcm_url` says so.
  Daemon(const std::filesystem::path& folder, const std::filesystem::path& rig,
         const std::vector<std::string>& more = {}, const std::string& lcm_url = "memq://");

  /// Waits until the daemon has logged `text`, or shown it in its status, the given number of times.
  bool logs(const std::string& text, std::size_t times = 1) const;
  /// Waits until odometry has come for the n-th time.
  bool has_odometry(std::size_t times = 1) const { return logs("odometry comes from", times); }
  /// Waits until `count` landmarks are mapped; needs --status.
  bool has_landmarks(int count) const;
  /// Sends SIGTERM and returns the exit code.
  std::optional<int> stop();
  /// Kills the daemon with SIGKILL.
  void kill();
};

/// A folder, and the rig of the robot that the test starts in it.
class Live : public ::testing::Test {
 protected:
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path records() const { return folder() / "log"; }
  /// A daemon that shows its status and records into records().
  std::unique_ptr<Daemon> recording_daemon(const std::vector<std::string>& more = {}) const;

  TemporaryFolder folder_;
  std::filesystem::path rig_ = Robot::write_rig(folder_.path());
};

}  // namespace azimuth::test
