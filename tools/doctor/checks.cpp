#include "tools/doctor/checks.hpp"

#include <utility>

namespace azimuth {
namespace {

Findings check_robot(const Machine& machine, const Plan& plan) {
  if (plan.devices.empty() && !plan.wants_serial) return {};  // odometry does not use a serial device
  const std::vector<std::string> devices = plan.devices.empty() ? serial_devices(machine) : plan.devices;
  Findings findings;
  for (const std::string& device : devices) append(findings, check_serial(machine, device));
  if (devices.empty())
    findings.push_back({"serial", Verdict::warning, "no USB serial adapter is plugged in; --device names another one",
                        "sudo dmesg | grep -i tty | tail"});
  return findings;
}

}  // namespace

Findings examine(const Machine& machine, const Plan& plan) {
  Findings findings{check_daemon_version(machine, plan.version), check_configuration(machine, plan.configuration)};
  append(findings, check_robot(machine, plan));
  append(findings, check_can(machine, plan));
  append(findings, check_cameras(machine, plan));
  append(findings, {check_group(machine, "dialout"), check_group(machine, "video")});
  append(findings, {check_multicast_route(machine), check_loopback_multicast(machine),
                    check_receive_buffer(machine, "rmem_max"), check_receive_buffer(machine, "rmem_default")});
  append(findings, check_supply(machine));
  append(findings, {check_heat(machine), check_cores(machine, plan.thread_cpus), check_memory(machine)});
  append(findings, {check_realtime_priority(machine), check_memory_lock(machine), check_cpu_governor(machine)});
  append(findings, {check_recording_folder(machine, plan.recording_folder, plan.min_free_mb), check_clock(machine)});
  return findings;
}

}  // namespace azimuth
