// azimuth doctor: finds what would stop the daemon on this machine.

#include <cstdio>
#include <memory>
#include <string>

#include "base/visible.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/doctor/checks.hpp"

namespace azimuth {
namespace {

struct DoctorOptions {
  Plan plan;
  std::string user;
  bool json = false;
};

void examine_machine(const DoctorOptions& options) {
  const std::optional<Machine> machine = this_machine(options.user);
  if (!machine) refuse("--user " + options.user + ": no such user");
  Plan plan = options.plan;
  add_installed(*machine, plan);
  if (!plan.configuration.empty()) add_configured(file_content(plan.configuration).value_or(""), plan);
  const Findings findings = examine(*machine, plan);
  std::fputs((options.json ? to_json(findings) : visible_lines(text(findings))).c_str(), stdout);
  if (worst(findings) == Verdict::error) throw CommandError{kFailure, ""};
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("doctor", "Find what would stop the daemon on this machine; exit code 1: an error was found");
  const auto options = std::make_shared<DoctorOptions>();
  options->plan.version = AZIMUTH_VERSION;
  command->add_option("--config", options->plan.configuration,
                      "Configuration of the daemon: the daemon checks it, and the command examines everything that it "
                      "uses; without it the configuration of the installed service");
  command->add_option("--device", options->plan.devices, "Serial device of the robot; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--record-folder", options->plan.recording_folder,
                      "Folder into which the daemon is to record, in place of the configuration's folder");
  command->add_option("--min-free-mb", options->plan.min_free_mb, "Space that recording leaves free on the disk, in MB")
      ->capture_default_str();
  command->add_option("--user", options->user, "User who runs the daemon; without it the user who calls the command");
  command->add_flag("--json", options->json, "Print the findings as JSON");
  command->callback([options] { examine_machine(*options); });
}

}  // namespace azimuth
