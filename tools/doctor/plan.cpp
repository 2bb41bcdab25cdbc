#include "tools/doctor/plan.hpp"

#include "settings/reader.hpp"
#include "settings/section.hpp"

namespace azimuth {
namespace {

/// The few keys of the daemon that say what it uses.
struct Configured {
  bool pioneer = false;
  std::string device = "/dev/ttyUSB0";
  std::string folder;
  double min_free_mb = 0.0;
};

std::vector<Section> sections(Configured& configured) {
  return {{"daemon.live", "", {choice<bool>("odometer", configured.pioneer, {{"none", false}, {"pioneer", true}}, "")}},
          {"daemon.pioneer", "", {{"device", &configured.device, ""}}},
          {"daemon.record", "", {{"folder", &configured.folder, ""}, {"min_free_mb", &configured.min_free_mb, ""}}}};
}

}  // namespace

void add_configured(std::string_view toml, Plan& plan) {
  Configured configured;
  configured.min_free_mb = plan.min_free_mb;
  std::vector<Section> tables = sections(configured);
  static_cast<void>(read_toml(toml, "", pointers(tables)));  // all the other keys are unknown here
  if (plan.devices.empty() && configured.pioneer) plan.devices.push_back(configured.device);
  if (!plan.recording_folder.empty()) return;
  plan.recording_folder = configured.folder;
  plan.min_free_mb = configured.min_free_mb;
}

}  // namespace azimuth
