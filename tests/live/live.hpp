#pragma once
// What the tests of the running daemon have in common.

#include <gtest/gtest.h>
#include <memory>

#include "tests/live/field_log.hpp"
#include "tests/live/robot.hpp"

namespace azimuth::test {

/// azimuthd with the options of a robot's owner: the simulated robot's configuration, and a field log.
class Daemon : public ChildProcess {
 public:
  /// The robot need not be there yet. Nothing goes to the network unless `lcm_url` says so.
  Daemon(const std::filesystem::path& folder, const std::filesystem::path& rig,
         const std::vector<std::string>& more = {}, const std::string& lcm_url = "memq://");

  /// Waits until it has logged or, when asked for its status, shown `text` so often.
  bool logs(const std::string& text, std::size_t times = 1) const;
  /// Waits until odometry comes for the n-th time.
  bool has_odometry(std::size_t times = 1) const { return logs("odometry comes from", times); }
  /// Waits until so many landmarks are mapped; needs --status.
  bool has_landmarks(int count) const;
  /// SIGTERM, and its exit code.
  std::optional<int> stop();
  /// Ends it as nothing could prevent.
  void kill();
};

/// A folder, and the rig of the robot that will be there.
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
