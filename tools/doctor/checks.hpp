#pragma once
// The checks. Each looks at one thing of a machine and says what it found; none changes anything, none needs root.
// Reentrant.

#include <cstdint>
#include <filesystem>
#include <string>

#include "tools/doctor/finding.hpp"
#include "tools/doctor/machine.hpp"
#include "tools/doctor/plan.hpp"

namespace azimuth {

inline constexpr std::int64_t kInterfaceUp = 0x1;  ///< IFF_UP, of an interface's flags

// One serial device (/dev/ttyUSB0, or a symbolic link to it).
Finding check_serial_device(const Machine& machine, const std::string& device);   ///< there, and open to the account
Finding check_serial_users(const Machine& machine, const std::string& device);    ///< used by nobody else
Findings check_latency_timer(const Machine& machine, const std::string& device);  ///< FTDI adapters only
Findings check_modem_manager(const Machine& machine, const std::string& device);  ///< none when it does not run
Findings check_serial(const Machine& machine, const std::string& device);         ///< all of these; "tcp:" has none
std::vector<std::string> serial_devices(const Machine& machine);                  ///< USB adapters that are plugged in

/// Each camera that is plugged in, of the kernel's video interface or IIDC, and the one that is configured.
Findings check_cameras(const Machine& machine, const Plan& plan);
/// Each CAN interface, and the one that is configured.
Findings check_can(const Machine& machine, const Plan& plan);
Finding check_group(const Machine& machine, const std::string& group);

Finding check_multicast_route(const Machine& machine);  ///< to LCM's group, 239.255.76.67
Finding check_loopback_multicast(const Machine& machine);
Finding check_receive_buffer(const Machine& machine, const std::string& key);  ///< rmem_max, rmem_default

Finding check_realtime_priority(const Machine& machine);
Finding check_memory_lock(const Machine& machine);
Finding check_cpu_governor(const Machine& machine);

Findings check_supply(const Machine& machine);  ///< the board's voltage; none where no sensor says
Finding check_heat(const Machine& machine);     ///< whether heat slows the processor down, or is about to
Finding check_cores(const Machine& machine, const std::vector<ThreadCpu>& threads);  ///< enough, and the fast ones
Finding check_memory(const Machine& machine);

/// Space and permission; `min_free_mb` is what recording leaves free.
Finding check_recording_folder(const Machine& machine, const std::filesystem::path& folder, double min_free_mb);
Finding check_clock(const Machine& machine);

Finding check_daemon_version(const Machine& machine, const std::string& own_version);
Finding check_configuration(const Machine& machine, const std::string& file);  ///< empty: none is given

}  // namespace azimuth
