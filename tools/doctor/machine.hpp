#pragma once
// The state of a machine that the checks examine. All information comes through this interface, so that a test can
// simulate any machine.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

#include "drivers/iidc/iidc_list.hpp"
#include "drivers/v4l2/v4l2_nodes.hpp"

namespace azimuth {

/// The account that will run the daemon.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::vector<gid_t> groups;       ///< groups of a new process of the account
  std::vector<gid_t> groups_here;  ///< groups of this process if it runs as the account; otherwise as `groups`
  bool is_here = false;            ///< this process runs as the account
};

/// Exit code and output (stdout and stderr) of a program.
struct ProgramOutcome {
  int exit_code = 0;
  std::string output;
};

struct Machine {
  std::filesystem::path root = "/";  ///< folder that contains dev, proc, sys, etc, run and usr
  Account account;
  std::optional<std::uint64_t> rtprio_limit;         ///< RLIMIT_RTPRIO
  std::optional<std::uint64_t> memlock_limit_bytes;  ///< RLIMIT_MEMLOCK; all bits set: unlimited
  std::optional<bool> clock_synchronised;            ///< as the kernel reports it
  /// Free bytes for the account on the disk of an existing folder.
  std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> free_bytes;
  /// Runs a program, which is searched in PATH; nothing if it cannot be started.
  std::function<std::optional<ProgramOutcome>(const std::vector<std::string>& command)> run;

  std::function<std::vector<v4l2::VideoNode>()> video_nodes;
  /// Nothing if libdc1394 does not answer.
  std::function<std::optional<IidcBus>()> iidc_cameras;

  /// The absolute `path` (as the daemon would name it), below `root`.
  std::filesystem::path at(std::string_view path) const;
};

/// The real machine. An empty `user` means the user of this process. Nothing if there is no such user.
std::optional<Machine> this_machine(const std::string& user);

// Functions that read small files of /proc, /sys and /etc. Nothing if a file cannot be read.
std::optional<std::string> file_content(const std::filesystem::path& file);
std::optional<std::string> first_line(const std::filesystem::path& file);
std::optional<std::int64_t> number_in(const std::filesystem::path& file, int base = 10);

/// The entries of a folder whose names begin with `prefix`, in natural order: ttyUSB2 before ttyUSB10.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder, std::string_view prefix);

/// The name of a group from the machine's /etc/group; its number if the group is not listed.
std::string group_name(const Machine& machine, gid_t group);
std::optional<gid_t> group_id(const Machine& machine, std::string_view name);

}  // namespace azimuth
