#include <fmt/format.h>
#include <string>

#include "tools/doctor/checks.hpp"
#include "tools/doctor/device_access.hpp"

namespace azimuth {

namespace fs = std::filesystem;

Finding check_recording_folder(const Machine& machine, const fs::path& folder, double min_free_mb) {
  constexpr const char* kCheck = "recording";
  const std::string name = folder.string(), owner = machine.account.name;
  if (name.empty()) return {kCheck, Verdict::ok, "nothing is recorded: no folder is given", ""};
  const fs::path here = machine.at(name);
  std::error_code error;
  if (!fs::exists(here, error)) {
    if (access_to(machine, here.parent_path()) == Access::granted)
      return {kCheck, Verdict::ok, name + " does not exist yet; the daemon will make it", ""};
    return {kCheck, Verdict::error, fmt::format("{} does not exist, and {} may not make it", name, owner),
            fmt::format("sudo install -d -o {} -m 0755 {}", owner, name)};
  }
  if (!fs::is_directory(here, error)) return {kCheck, Verdict::error, name + " is not a folder", "ls -l " + name};
  if (access_to(machine, here) == Access::denied)
    return {kCheck, Verdict::error, fmt::format("{} may not write to {}", owner, name),
            fmt::format("sudo chown {} {}", owner, name)};
  const auto free = machine.free_bytes ? machine.free_bytes(here) : std::nullopt;
  if (!free) return {kCheck, Verdict::unknown, "the disk of " + name + " does not say how full it is", ""};
  const double free_mb = static_cast<double>(*free) / 1e6;
  const std::string found = fmt::format("{:.0f} MB are free on the disk of {}", free_mb, name);
  if (free_mb >= 2.0 * min_free_mb) return {kCheck, Verdict::ok, found, ""};
  return {kCheck, free_mb < min_free_mb ? Verdict::error : Verdict::warning,
          fmt::format("{}, and recording leaves {:.0f} MB free", found, min_free_mb),
          fmt::format("du -xh --max-depth=2 {} | sort -h | tail", name)};
}

Finding check_clock(const Machine& machine) {
  constexpr const char* kCheck = "clock";
  if (!machine.clock_synchronised)
    return {kCheck, Verdict::unknown, "the kernel does not say how good its clock is", ""};
  if (*machine.clock_synchronised) return {kCheck, Verdict::ok, "the clock is synchronised", ""};
  return {kCheck, Verdict::warning,
          "the clock is not synchronised: stamps and the names of recordings may be wrong, and the clock may jump",
          "sudo timedatectl set-ntp true"};
}

}  // namespace azimuth
