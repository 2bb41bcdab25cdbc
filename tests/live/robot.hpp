#pragma once
// Runs azimuth-sim as a process beside the daemon: a robot at a pseudo-terminal, and its camera at a socket.

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tests/daemon/child_process.hpp"

namespace azimuth::test {

/// Time limit for events that must come, on a machine that is many times slower than usual.
inline constexpr std::chrono::seconds kPatience{60};

/// A simulated robot that drives through the lab. Its paths in `folder` are the same for every robot, so another robot
/// can take its place. Thread contract: thread-bound.
class Robot {
 public:
  /// Starts azimuth-sim with the further options `more`, and waits until it can be reached.
  explicit Robot(std::filesystem::path folder, const std::vector<std::string>& more = {});

  static std::filesystem::path device(const std::filesystem::path& folder) { return folder / "pioneer"; }
  static std::filesystem::path camera(const std::filesystem::path& folder) { return folder / "camera.sock"; }
  /// Writes the rig.toml of a robot with the options `more`, without starting it.
  static std::filesystem::path write_rig(const std::filesystem::path& folder,
                                         const std::vector<std::string>& more = {});

  /// The TCP port on which it listens, if it was started with --tcp.
  std::uint16_t port() const;

  /// Sends a command, such as the name of a fault, and returns the answer.
  std::string obey(const std::string& command) const;

  /// Waits until the robot has printed `news` the given number of times.
  bool tells(const std::string& news, std::size_t times = 1) const;
  /// Everything that the robot has printed so far.
  std::string told() const { return process_.standard_output(); }

  /// Ends the robot with the signal and waits for its exit. Except after SIGKILL, truth() is then complete.
  std::optional<int> end(int signal = SIGTERM);

  /// The true drive: landmarks, and poses on the daemon's clock.
  Run truth() const;
  /// When the robot first printed `news`, on the daemon's clock. Throws if it never did.
  Stamp when(const std::string& news) const;

 private:
  std::filesystem::path folder_;
  ChildProcess process_;
};

}  // namespace azimuth::test
