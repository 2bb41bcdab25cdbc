#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/doctor/machine.hpp"

namespace azimuth {

/// A thread that is bound to one core.
struct ThreadCpu {
  std::string key;  ///< key in daemon.realtime
  int cpu = 0;
};

/// The resources that the daemon will use on the machine.
struct Plan {
  std::vector<std::string> devices;  ///< serial devices of the robot; empty: all connected USB adapters
  std::string recording_folder;      ///< empty if nothing is recorded
  double min_free_mb = 500.0;        ///< space that recording leaves free
  std::string configuration;         ///< configuration file; empty: not checked
  std::string version;               ///< version of this program

  // Sensors in the configuration. Without a configuration, all kinds of sensors are checked.
  bool wants_serial = true, wants_camera = true;  ///< false if such a device is not used
  std::optional<std::string> v4l2_device{};       ///< configured V4L2 camera, if any
  std::optional<std::string> iidc_guid{};         ///< configured IIDC camera, if any; empty string: any camera
  std::optional<std::string> can_interface{};     ///< CAN interface of the odometry, if any
  std::vector<ThreadCpu> thread_cpus{};           ///< threads that are bound to a core
};

/// Location of the daemon's configuration in the package; the service reads this file.
inline constexpr std::string_view kInstalledConfiguration = "/etc/azimuthd/azimuthd.toml";

/// If the plan has no configuration, sets the one of the installed service, if the machine has one.
void add_installed(const Machine& machine, Plan& plan);

/// Takes the robot's devices from the daemon's configuration, and the recording folder if the plan has none. Errors in
/// `toml` are ignored here, since check_configuration() lets the daemon report them. Reentrant.
void add_configured(std::string_view toml, Plan& plan);

}  // namespace azimuth
