#include "tools/doctor/plan.hpp"

#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "drivers/can/can_settings.hpp"
#include "drivers/pioneer/device_link.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"
#include "settings/path_text.hpp"
#include "settings/reader.hpp"
#include "settings/section.hpp"

namespace azimuth {
namespace {

/// The keys of the daemon's configuration that determine the resources it uses.
struct Configured {
  std::string odometer = "none", camera = "none";  // kinds of sources
  std::string device = "/dev/ttyUSB0";
  std::string v4l2_device = V4l2Settings{}.device, iidc_guid, can_interface = CanSettings{}.interface;
  std::string folder;
  double min_free_mb = 0.0;
  // Cores of the threads by key; -1: any core.
  std::array<std::pair<const char*, int>, 5> cpus{
      {{"source_cpu", -1}, {"perception_cpu", -1}, {"estimator_cpu", -1}, {"publisher_cpu", -1}, {"recorder_cpu", -1}}};
};

std::string_view serial_device(std::string_view device) {
  return pioneer::DeviceLink::is_serial(std::string(device)) ? device : std::string_view();
}

Section cpu_section(Configured& configured) {
  Section section{"daemon.realtime", "", {}};
  for (auto& [key, cpu] : configured.cpus) section.keys.push_back({key, &cpu, ""});
  return section;
}

std::vector<Section> sections(Configured& configured) {
  return {
      {"daemon.live", "", {{"odometer", &configured.odometer, ""}, {"camera", &configured.camera, ""}}},
      {"daemon.pioneer", "", {{"device", PathText{&configured.device, serial_device}, ""}}},
      {"daemon.v4l2", "", {{"device", &configured.v4l2_device, ""}}},
      {"daemon.iidc", "", {{"guid", &configured.iidc_guid, ""}}},
      {"daemon.can", "", {{"interface", &configured.can_interface, ""}}},
      {"daemon.record", "", {path_key("folder", configured.folder, ""), {"min_free_mb", &configured.min_free_mb, ""}}},
      cpu_section(configured)};
}

/// A configuration without odometer or camera counts as unfinished; then all kinds of sensors are checked.
void add_sensors(const Configured& configured, Plan& plan) {
  const std::string &odometer = configured.odometer, &camera = configured.camera;
  if (odometer == "pioneer" && plan.devices.empty()) plan.devices.push_back(configured.device);
  if (odometer == "can") plan.can_interface = configured.can_interface;
  if (camera == "v4l2") plan.v4l2_device = configured.v4l2_device;
  if (camera == "iidc") plan.iidc_guid = configured.iidc_guid;
  plan.wants_serial = odometer == "none" || odometer == "pioneer";
  plan.wants_camera = camera == "none" || camera == "v4l2" || camera == "iidc";
}

}  // namespace

void add_installed(const Machine& machine, Plan& plan) {
  std::error_code error;
  if (plan.configuration.empty() && std::filesystem::exists(machine.at(kInstalledConfiguration), error))
    plan.configuration = kInstalledConfiguration;
}

void add_configured(std::string_view toml, Plan& plan) {
  Configured configured;
  configured.min_free_mb = plan.min_free_mb;
  std::vector<Section> tables = sections(configured);
  static_cast<void>(read_toml(toml, "", pointers(tables)));              // ignores other keys
  static_cast<void>(place_paths(pointers(tables), plan.configuration));  // the daemon reports errors
  add_sensors(configured, plan);
  for (const auto& [key, cpu] : configured.cpus)
    if (cpu >= 0) plan.thread_cpus.push_back({key, cpu});
  if (!plan.recording_folder.empty()) return;
  plan.recording_folder = configured.folder;
  plan.min_free_mb = configured.min_free_mb;
}

}  // namespace azimuth
