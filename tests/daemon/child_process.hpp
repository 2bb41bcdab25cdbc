#pragma once
// Programs under test as processes of their own.

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

/// A running program. Its output goes into files. The destructor kills it if it still runs.
class ChildProcess {
 public:
  /// `environment` adds `NAME=value`s; `folder` receives the output.
  ChildProcess(std::vector<std::string> command, const std::filesystem::path& folder,
               const std::vector<std::string>& environment = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number) const;

  /// The exit code (128 + signal when one killed it), once it has ended; nothing when it has not within `limit`.
  std::optional<int> wait(std::chrono::milliseconds limit);

  std::string standard_output() const;
  std::string standard_error() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  std::filesystem::path output_, error_;
};

/// Asks until it is true; false when it never is within `limit`.
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
