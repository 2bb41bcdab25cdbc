#pragma once
// Runs the programs under test as separate processes.

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

/// A running program. Its output goes into files. The destructor kills the program if it still runs.
class ChildProcess {
 public:
  /// `environment` adds entries of the form `NAME=value`. `folder` receives the output files.
  ChildProcess(std::vector<std::string> command, const std::filesystem::path& folder,
               const std::vector<std::string>& environment = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number) const;

  /// Waits for the end and returns the exit code (128 + signal if a signal killed it); nullopt after `limit`.
  std::optional<int> wait(std::chrono::milliseconds limit);

  std::string standard_output() const;
  std::string standard_error() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  std::filesystem::path output_, error_;
};

/// Polls the condition until it is true; returns false after `limit`.
template <class Condition>
bool eventually(const Condition& condition, std::chrono::milliseconds limit);

}  // namespace azimuth::test

#include <thread>

template <class Condition>
bool azimuth::test::eventually(const Condition& condition, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}
