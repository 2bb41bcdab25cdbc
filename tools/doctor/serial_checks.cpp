#include <fmt/format.h>

#include "tools/doctor/checks.hpp"
#include "tools/doctor/device_access.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSerialCheck = "serial";
constexpr std::int64_t kGoodLatency_ms = 1;

/// Resolves a symbolic link such as /dev/pioneer to the kernel's name, for example "/dev/ttyUSB0".
fs::path real_device(const Machine& machine, const std::string& device) {
  std::error_code error;
  const fs::path target = fs::read_symlink(machine.at(device), error);
  if (error) return device;
  return target.is_absolute() ? target : (fs::path(device).parent_path() / target).lexically_normal();
}

/// The udev properties of a device, found by its device number: lines "E:KEY=VALUE".
std::string udev_properties(const Machine& machine, const std::string& name) {
  const auto number = first_line(machine.at("/sys/class/tty/" + name + "/dev"));
  return number ? file_content(machine.at("/run/udev/data/c" + *number)).value_or("") : "";
}

bool is_tcp(const std::string& device) { return device.starts_with("tcp:"); }

}  // namespace

std::vector<std::string> serial_devices(const Machine& machine) {
  std::vector<std::string> devices;
  for (const char* prefix : {"ttyUSB", "ttyACM"}) {
    for (const fs::path& entry : entries(machine.at("/dev"), prefix))
      devices.push_back("/dev/" + entry.filename().string());
  }
  return devices;
}

Finding check_serial_device(const Machine& machine, const std::string& device) {
  const fs::path file = machine.at(real_device(machine, device).string());
  switch (access_to(machine, file)) {
    case Access::missing:
      return {kSerialCheck, Verdict::error, device + " is not there: no adapter is plugged in, or it has another name",
              "ls -l /dev/serial/by-id/\nsudo dmesg | grep -i tty | tail"};
    case Access::denied:
      return denied(machine, kSerialCheck, device, file, "dialout");
    case Access::granted:
      break;
  }
  return {kSerialCheck, Verdict::ok, fmt::format("{} is there, {} may use it", device, machine.account.name), ""};
}

Finding check_serial_users(const Machine& machine, const std::string& device) {
  const fs::path real = real_device(machine, device);
  for (const Process& process : users_of(machine, real)) {
    if (process.name == "azimuthd") return {kSerialCheck, Verdict::ok, device + " is used by azimuthd", ""};
    return {kSerialCheck, Verdict::error,
            fmt::format("{} is used by {} (process {})", device, process.name, process.pid),
            fmt::format("kill {}", process.pid)};
  }
  const std::string lock = "/var/lock/LCK.." + real.filename().string();
  if (const auto holder = number_in(machine.at(lock));
      holder && fs::exists(machine.at(fmt::format("/proc/{}", *holder)))) {
    return {kSerialCheck, Verdict::error, fmt::format("{} is locked by process {} ({})", device, *holder, lock),
            fmt::format("kill {}", *holder)};
  }
  return {kSerialCheck, Verdict::ok, device + " is used by nobody this user can see", ""};
}

Findings check_latency_timer(const Machine& machine, const std::string& device) {
  const std::string name = real_device(machine, device).filename().string();
  const std::string file = "/sys/bus/usb-serial/devices/" + name + "/latency_timer";
  const auto latency_ms = number_in(machine.at(file));
  if (!latency_ms) return {};  // not an FTDI adapter
  if (*latency_ms <= kGoodLatency_ms)
    return {{"latency", Verdict::ok, fmt::format("{} hands bytes over within {} ms", device, *latency_ms), ""}};
  return {
      {"latency", Verdict::warning,
       fmt::format("{} keeps bytes for up to {} ms: odometry is stamped that much less surely", device, *latency_ms),
       fmt::format("echo 1 | sudo tee {}\n"
                   "echo 'ACTION==\"add\", SUBSYSTEM==\"usb-serial\", DRIVER==\"ftdi_sio\", "
                   "ATTR{{latency_timer}}=\"1\"' | sudo tee /etc/udev/rules.d/60-ftdi-latency.rules",
                   file)}};
}

Findings check_modem_manager(const Machine& machine, const std::string& device) {
  const auto manager = process_named(machine, "ModemManager");
  if (!manager) return {};
  const std::string name = real_device(machine, device).filename().string();
  if (udev_properties(machine, name).find("E:ID_MM_DEVICE_IGNORE=1") != std::string::npos)
    return {{"modems", Verdict::ok, "ModemManager is told to leave " + device + " alone", ""}};
  return {{"modems", Verdict::warning,
           fmt::format("ModemManager runs (process {}) and talks to {} when it is plugged in", manager->pid, device),
           "sudo systemctl disable --now ModemManager"}};
}

Findings check_serial(const Machine& machine, const std::string& device) {
  if (is_tcp(device)) return {};
  Findings findings{check_serial_device(machine, device)};
  if (access_to(machine, machine.at(real_device(machine, device).string())) == Access::missing) return findings;
  findings.push_back(check_serial_users(machine, device));
  for (const auto& more : {check_latency_timer(machine, device), check_modem_manager(machine, device)})
    findings.insert(findings.end(), more.begin(), more.end());
  return findings;
}

}  // namespace azimuth
