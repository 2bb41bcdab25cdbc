#pragma once
// A fixture that replaces the machine by files in a temporary folder.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temporary_folder.hpp"
#include "tools/doctor/checks.hpp"

namespace azimuth::test {

namespace fs = std::filesystem;

/// An empty machine. The account "ada" belongs to its own group only.
class FakeMachine : public testing::Test {
 protected:
  FakeMachine() {
    machine.root = folder_.path();
    machine.account = {"ada", kUid, {kOwnGroup}, {kOwnGroup}};
    machine.rtprio_limit = 0;
    machine.memlock_limit_bytes = 8 << 20;
    write("/etc/group", "root:x:0:\ndialout:x:20:ada\nbroken\nvideo:x:" + std::to_string(file_group()) + ":\n");
  }

  fs::path write(const std::string& path, const std::string& content = "", mode_t mode = 0644) {
    const fs::path file = machine.at(path);
    fs::create_directories(file.parent_path());
    std::ofstream(file) << content;
    ::chmod(file.c_str(), mode);
    return file;
  }
  void link(const std::string& path, const std::string& target) {
    fs::create_directories(machine.at(path).parent_path());
    fs::create_symlink(target, machine.at(path));
  }
  void process(int pid, const std::string& name, const std::string& opened = "") {
    const std::string folder = "/proc/" + std::to_string(pid);
    write(folder + "/comm", name + "\n");
    if (!opened.empty()) link(folder + "/fd/5", opened);
  }
  /// The group of the created files, which an ordinary user cannot change.
  static gid_t file_group() { return ::getegid() == 0 ? 0 : ::getegid(); }
  /// Makes the account a member of the group of the files.
  void join_files_group() {
    machine.account.groups.push_back(file_group());
    machine.account.groups_here.push_back(file_group());
  }

  static constexpr uid_t kUid = 54'321;
  static constexpr gid_t kOwnGroup = 54'321;
  Machine machine;

 private:
  TemporaryFolder folder_;
};

MATCHER_P2(IsFinding, verdict, words, "") {
  *result_listener << to_string(arg.verdict) << ": " << arg.what;
  return arg.verdict == verdict && arg.what.find(words) != std::string::npos;
}

}  // namespace azimuth::test
