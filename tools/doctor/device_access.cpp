#include "tools/doctor/device_access.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>

#include "tools/doctor/checks.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kReadWrite = 6;

bool contains(const std::vector<gid_t>& groups, gid_t group) { return std::ranges::count(groups, group) > 0; }

std::vector<Process> processes(const Machine& machine) {
  std::vector<Process> found;
  for (const fs::path& entry : entries(machine.at("/proc"), "")) {
    const std::string name = entry.filename().string();
    if (!std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    found.push_back({std::stoi(name), first_line(entry / "comm").value_or("?")});
  }
  return found;
}

bool has_open(const Machine& machine, const Process& process, const fs::path& file) {
  std::error_code error;
  for (const fs::path& descriptor : entries(machine.at(fmt::format("/proc/{}/fd", process.pid)), "")) {
    if (fs::read_symlink(descriptor, error) == file) return true;
  }
  return false;
}

}  // namespace

Access access_to(const Machine& machine, const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return Access::missing;
  const Account& account = machine.account;
  if (account.uid == 0) return Access::granted;
  const mode_t mode = status.st_uid == account.uid                   ? status.st_mode >> 6U
                      : contains(account.groups_here, status.st_gid) ? status.st_mode >> 3U
                                                                     : status.st_mode;
  return (mode & kReadWrite) == kReadWrite ? Access::granted : Access::denied;
}

std::string join_group(const Machine& machine, gid_t group) {
  const Account& account = machine.account;
  if (contains(account.groups, group)) return "# log out and in again: then the new groups count";
  return fmt::format("sudo usermod -aG {} {}\n# then log out and in again, or restart the service",
                     group_name(machine, group), account.name);
}

Finding denied(const Machine& machine, const std::string& check, const std::string& device, const fs::path& file,
               const std::string& usual_group) {
  struct stat status {};
  ::stat(file.c_str(), &status);
  const std::string node = device.substr(0, device.find(' '));
  const bool group_helps = ((status.st_mode >> 3U) & kReadWrite) == kReadWrite && status.st_gid != 0 &&
                           !contains(machine.account.groups_here, status.st_gid);
  Finding finding{check, Verdict::error, fmt::format("{} may not read and write {}", machine.account.name, device), ""};
  if (group_helps) {
    finding.what += fmt::format(", group {} may", group_name(machine, status.st_gid));
    finding.fix = join_group(machine, status.st_gid);
  } else {
    finding.fix = fmt::format(
        "sudo chmod g+rw {0} && sudo chgrp {1} {0}  # until it is plugged in again; for good: a udev rule with "
        "GROUP=\"{1}\", MODE=\"0660\"",
        node, usual_group);
  }
  return finding;
}

std::vector<Process> users_of(const Machine& machine, const fs::path& file) {
  std::vector<Process> users;
  for (const Process& process : processes(machine)) {
    if (has_open(machine, process, file)) users.push_back(process);
  }
  return users;
}

std::optional<Process> process_named(const Machine& machine, std::string_view name) {
  constexpr std::size_t kLongestName = 15;  // the kernel truncates names to this length
  for (const Process& process : processes(machine)) {
    if (process.name == name.substr(0, kLongestName)) return process;
  }
  return std::nullopt;
}

Finding check_group(const Machine& machine, const std::string& group) {
  const auto id = group_id(machine, group);
  const Account& account = machine.account;
  if (!id) return {"groups", Verdict::unknown, "there is no group " + group + " here", ""};
  if (account.uid == 0) return {"groups", Verdict::ok, "root needs no group " + group, ""};
  if (std::ranges::count(account.groups_here, *id) > 0)
    return {"groups", Verdict::ok, fmt::format("{} is in group {}", account.name, group), ""};
  const bool stale = std::ranges::count(account.groups, *id) > 0;
  return {"groups", Verdict::warning,
          stale ? fmt::format("{} was added to group {} after this session began", account.name, group)
                : fmt::format("{} is not in group {}", account.name, group),
          join_group(machine, *id)};
}

}  // namespace azimuth
