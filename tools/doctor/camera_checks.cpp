#include <algorithm>
#include <fmt/format.h>

#include "tools/doctor/checks.hpp"
#include "tools/doctor/device_access.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCheck = "camera";

Finding check_camera(const Machine& machine, const fs::path& file) {
  const std::string name = file.filename().string(), device = "/dev/" + name;
  if (access_to(machine, file) == Access::denied) return denied(machine, kCheck, device, file);
  const auto model = first_line(machine.at("/sys/class/video4linux/" + name + "/name"));
  return {kCheck, Verdict::ok,
          fmt::format("{}{}, {} may use it", device, model ? " (" + *model + ")" : "", machine.account.name), ""};
}

}  // namespace

Findings check_cameras(const Machine& machine) {
  Findings findings;
  for (const char* prefix : {"video", "fw"}) {
    for (const fs::path& file : entries(machine.at("/dev"), prefix)) findings.push_back(check_camera(machine, file));
  }
  if (findings.empty())
    findings.push_back({kCheck, Verdict::warning, "no camera is plugged in (no /dev/video*, no /dev/fw*)",
                        "sudo dmesg | grep -iE 'video|camera|firewire' | tail"});
  return findings;
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
