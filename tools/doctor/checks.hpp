#pragma once
// The checks of `azimuth doctor`. Each check examines one property of a machine and returns its findings. No check
// changes anything or needs root. Reentrant.

#include <cstdint>
#include <filesystem>
#include <string>

#include "tools/doctor/finding.hpp"
#include "tools/doctor/machine.hpp"
#include "tools/doctor/plan.hpp"

namespace azimuth {

/// Runs all checks, in the order in which a robot is set up.
Findings examine(const Machine& machine, const Plan& plan);

inline constexpr std::int64_t kInterfaceUp = 0x1;  ///< IFF_UP in the flags of an interface

// Checks of one serial device (/dev/ttyUSB0, or a symbolic link to it).
Finding check_serial_device(const Machine& machine, const std::string& device);   ///< exists and is accessible
Finding check_serial_users(const Machine& machine, const std::string& device);    ///< no other process uses it
Findings check_latency_timer(const Machine& machine, const std::string& device);  ///< FTDI adapters only
Findings check_modem_manager(const Machine& machine, const std::string& device);  ///< empty if it does not run
Findings check_serial(const Machine& machine, const std::string& device);         ///< all; none for "tcp:"
std::vector<std::string> serial_devices(const Machine& machine);                  ///< connected USB adapters

/// All connected V4L2 and IIDC cameras, and the configured one.
Findings check_cameras(const Machine& machine, const Plan& plan);
/// All CAN interfaces, and the configured one.
Findings check_can(const Machine& machine, const Plan& plan);
Finding check_group(const Machine& machine, const std::string& group);

Finding check_multicast_route(const Machine& machine);  ///< route to LCM's group 239.255.76.67
Finding check_loopback_multicast(const Machine& machine);
Finding check_receive_buffer(const Machine& machine, const std::string& key);  ///< rmem_max, rmem_default

Finding check_realtime_priority(const Machine& machine);
Finding check_memory_lock(const Machine& machine);
Finding check_cpu_governor(const Machine& machine);

Findings check_supply(const Machine& machine);  ///< supply voltage; empty without a sensor
Finding check_heat(const Machine& machine);     ///< thermal throttling, present or near
Finding check_cores(const Machine& machine, const std::vector<ThreadCpu>& threads);  ///< number and speed
Finding check_memory(const Machine& machine);

/// Free space and write permission. `min_free_mb`: space that recording leaves free.
Finding check_recording_folder(const Machine& machine, const std::filesystem::path& folder, double min_free_mb);
Finding check_clock(const Machine& machine);

Finding check_daemon_version(const Machine& machine, const std::string& own_version);
Finding check_configuration(const Machine& machine, const std::string& file);  ///< may be empty

}  // namespace azimuth
