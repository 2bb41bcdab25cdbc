#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "tools/doctor/checks.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kGoodPriority = 60;

/// The text of the service's unit file. The folders are searched in systemd's order.
std::optional<std::string> unit_file(const Machine& machine) {
  for (const char* folder : {"/etc/systemd/system/", "/run/systemd/system/", "/usr/lib/systemd/system/",
                             "/lib/systemd/system/", "/usr/local/lib/systemd/system/"}) {
    if (auto unit = file_content(machine.at(std::string(folder) + "azimuthd.service"))) return unit;
  }
  return std::nullopt;
}

/// True if the installed service sets this limit itself, so that the limits of a login do not apply to it.
bool set_by_unit(const Machine& machine, const std::string& key) {
  const auto unit = unit_file(machine);
  return unit && ("\n" + *unit).find("\n" + key + "=") != std::string::npos;
}

Finding check_limit(const Machine& machine, const std::optional<std::uint64_t>& limit, std::uint64_t enough,
                    const std::string& unit_key, const std::string& what, const std::string& line) {
  if (set_by_unit(machine, unit_key))
    return {"limits", Verdict::ok, fmt::format("azimuthd.service sets {} itself", unit_key), ""};
  if (machine.account.uid == 0) return {"limits", Verdict::ok, what + ": root needs no leave", ""};
  if (!limit) return {"limits", Verdict::unknown, what + ": only known when run as " + machine.account.name, ""};
  if (*limit >= enough) return {"limits", Verdict::ok, what + ": allowed", ""};
  return {"limits", Verdict::warning, fmt::format("{}: not allowed to {}", what, machine.account.name),
          fmt::format("echo '{} - {}' | sudo tee -a /etc/security/limits.d/azimuth.conf\n# then log out and in again",
                      machine.account.name, line)};
}

}  // namespace

Finding check_realtime_priority(const Machine& machine) {
  return check_limit(machine, machine.rtprio_limit, kGoodPriority, "LimitRTPRIO",
                     fmt::format("real-time priority up to {}", kGoodPriority),
                     fmt::format("rtprio {}", kGoodPriority));
}

Finding check_memory_lock(const Machine& machine) {
  return check_limit(machine, machine.memlock_limit_bytes, kUnlimited, "LimitMEMLOCK", "locking all memory",
                     "memlock unlimited");
}

Finding check_cpu_governor(const Machine& machine) {
  std::map<std::string, int> governors;
  for (const fs::path& cpu : entries(machine.at("/sys/devices/system/cpu"), "cpu")) {
    if (const auto governor = first_line(cpu / "cpufreq/scaling_governor")) ++governors[*governor];
  }
  if (governors.empty()) return {"governor", Verdict::ok, "the processor's frequency is not scaled", ""};
  if (governors.size() == 1 && governors.begin()->first == "performance")
    return {"governor", Verdict::ok, "the processor runs at full speed", ""};
  governors.erase("performance");
  return {"governor", Verdict::warning,
          fmt::format("{} processors follow the governor \"{}\": steps take longer after a pause",
                      governors.begin()->second, governors.begin()->first),
          "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor"};
}

}  // namespace azimuth
