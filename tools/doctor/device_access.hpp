#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/finding.hpp"
#include "tools/doctor/machine.hpp"

namespace azimuth {

enum class Access { granted, denied, missing };

/// Whether the account may read and write a file, by the file's owner, group and mode: the daemon is not run for it.
Access access_to(const Machine& machine, const std::filesystem::path& file);

/// A denial as a finding: names the group that would be let in, and how the account gets into it; else how the device
/// is given to `usual_group`. `device` is its path, and after a blank what else is known of it.
Finding denied(const Machine& machine, const std::string& check, const std::string& device,
               const std::filesystem::path& file, const std::string& usual_group);

/// The commands that put the account into a group, or the hint to log in again when it is in it, but this process not.
std::string join_group(const Machine& machine, gid_t group);

struct Process {
  int pid = 0;
  std::string name;
};

/// Processes that have the file open, among those whose files may be looked into.
std::vector<Process> users_of(const Machine& machine, const std::filesystem::path& file);

/// A process of this name; nothing when none runs.
std::optional<Process> process_named(const Machine& machine, std::string_view name);

}  // namespace azimuth
