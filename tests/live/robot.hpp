#pragma once
// azimuth-sim as a process beside the daemon's: a robot at a pseudo-terminal, its camera at a socket.

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tests/daemon/child_process.hpp"

namespace azimuth::test {

/// For whatever comes by itself, on a machine that is many times slower than usual.
inline constexpr std::chrono::seconds kPatience{60};

/// A simulated robot that drives through the lab. It is reached at paths of `folder`, also when another one has taken
/// its place there. Thread contract: thread-bound.
class Robot {
 public:
  /// Starts it, with `more` options of azimuth-sim, and waits until it can be reached.
  explicit Robot(std::filesystem::path folder, const std::vector<std::string>& more = {});

  static std::filesystem::path device(const std::filesystem::path& folder) { return folder / "pioneer"; }
  static std::filesystem::path camera(const std::filesystem::path& folder) { return folder / "camera.sock"; }
  /// Writes the rig.toml of such a robot, with `more` options, without starting one.
  static std::filesystem::path write_rig(const std::filesystem::path& folder,
                                         const std::vector<std::string>& more = {});

  /// Where it listens, if it was started with --tcp.
  std::uint16_t port() const;

  /// Gives it a command, such as a fault by its name; the answer.
  std::string obey(const std::string& command) const;

  /// Waits until it has told `news` so often.
  bool tells(const std::string& news, std::size_t times = 1) const;
  /// What it told so far.
  std::string told() const { return process_.standard_output(); }

  /// Ends it and waits for that. After anything gentler than SIGKILL truth() is complete.
  std::optional<int> end(int signal = SIGTERM);

  /// The drive as it was: landmarks, and poses on the daemon's clock.
  Run truth() const;
  /// When it first told `news`, on that clock; requires that it did.
  Stamp when(const std::string& news) const;

 private:
  std::filesystem::path folder_;
  ChildProcess process_;
};

}  // namespace azimuth::test
