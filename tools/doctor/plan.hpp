#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/doctor/machine.hpp"

namespace azimuth {

/// A thread that is to run on one core only.
struct ThreadCpu {
  std::string key;  ///< of daemon.realtime
  int cpu = 0;
};

/// What the daemon is to use on the machine.
struct Plan {
  std::vector<std::string> devices;  ///< of the robot; empty: every USB adapter that is plugged in
  std::string recording_folder;      ///< empty: nothing is recorded
  double min_free_mb = 500.0;        ///< what recording leaves free
  std::string configuration;         ///< file; empty: not checked
  std::string version;               ///< of this program

  // What the configuration says of sensors. Without one any may be meant.
  bool wants_serial = true, wants_camera = true;  ///< false: such a device is not used
  std::optional<std::string> v4l2_device{};       ///< of the camera that is to be used, if it is of that kind
  std::optional<std::string> iidc_guid{};         ///< likewise; empty: any
  std::optional<std::string> can_interface{};     ///< of the odometry, if it comes from there
  std::vector<ThreadCpu> thread_cpus{};           ///< those that are given one
};

/// Where the package puts the daemon's configuration; the service reads it there.
inline constexpr std::string_view kInstalledConfiguration = "/etc/azimuthd/azimuthd.toml";

/// Without a configuration the plan gets that of the installed service, if there is one on the machine.
void add_installed(const Machine& machine, Plan& plan);

/// Fills in what the daemon's configuration says of the robot's devices, and of recording if the plan has no folder
/// yet. Whatever is wrong with `toml` is passed over here: check_configuration() has the daemon itself name it.
/// Reentrant.
void add_configured(std::string_view toml, Plan& plan);

}  // namespace azimuth
