#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/finding.hpp"
#include "tools/doctor/machine.hpp"

namespace azimuth {

enum class Access { granted, denied, missing };

/// Access of the account to a file (read and write), derived from the file's owner, group and mode.
Access access_to(const Machine& machine, const std::filesystem::path& file);

/// A finding for denied access. It names the group that has access and the command that adds the account to the group.
/// If no group has access, it says how to give the device to `usual_group`. `device`: path of the device, optionally
/// followed by a blank and a description.
Finding denied(const Machine& machine, const std::string& check, const std::string& device,
               const std::filesystem::path& file, const std::string& usual_group);

/// The commands that add the account to a group. If the account is already a member but this process is not, a hint to
/// log in again.
std::string join_group(const Machine& machine, gid_t group);

struct Process {
  int pid = 0;
  std::string name;
};

/// Processes that have the file open. Only processes whose open files are readable are considered.
std::vector<Process> users_of(const Machine& machine, const std::filesystem::path& file);

/// A running process with this name; nothing if there is none.
std::optional<Process> process_named(const Machine& machine, std::string_view name);

}  // namespace azimuth
