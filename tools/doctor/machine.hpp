#pragma once
// What the checks know of a machine. Everything comes in from here, so that a test can make up any machine.

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

/// Who is to run the daemon.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::vector<gid_t> groups;       ///< those a process of the account gets when it starts
  std::vector<gid_t> groups_here;  ///< those of this very process, if it runs as the account; else as above
  bool is_here = false;            ///< this very process runs as the account
};

/// What a program printed on either output, and how it ended.
struct ProgramOutcome {
  int exit_code = 0;
  std::string output;
};

struct Machine {
  std::filesystem::path root = "/";  ///< where dev, proc, sys, etc, run and usr are
  Account account;
  std::optional<std::uint64_t> rtprio_limit;         ///< RLIMIT_RTPRIO
  std::optional<std::uint64_t> memlock_limit_bytes;  ///< RLIMIT_MEMLOCK; all ones: unlimited
  std::optional<bool> clock_synchronised;            ///< what the kernel says
  /// Bytes free for the account on the disk of an existing folder.
  std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> free_bytes;
  /// Runs a program, found by PATH; nothing when it cannot be started.
  std::function<std::optional<ProgramOutcome>(const std::vector<std::string>& command)> run;

  std::function<std::vector<v4l2::VideoNode>()> video_nodes;
  /// Nothing when libdc1394 does not answer.
  std::function<std::optional<IidcBus>()> iidc_cameras;

  /// `path` (absolute, as the daemon would name it) under the root.
  std::filesystem::path at(std::string_view path) const;
};

/// This machine. `user` empty: whoever runs this process. Nothing when there is no such user.
std::optional<Machine> this_machine(const std::string& user);

// Reading the small files of /proc, /sys and /etc. Nothing when a file cannot be read.
std::optional<std::string> file_content(const std::filesystem::path& file);
std::optional<std::string> first_line(const std::filesystem::path& file);
std::optional<std::int64_t> number_in(const std::filesystem::path& file, int base = 10);

/// The entries of a folder whose names begin with `prefix`, in the order of names with numbers in them.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder, std::string_view prefix);

/// The name of a group by the machine's /etc/group; its number when it is not there.
std::string group_name(const Machine& machine, gid_t group);
std::optional<gid_t> group_id(const Machine& machine, std::string_view name);

}  // namespace azimuth
