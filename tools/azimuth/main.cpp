#include <CLI/CLI.hpp>
#include <exception>
#include <string>

#include "base/visible.hpp"
#include "settings/command_line/command_line.hpp"
#include "tools/azimuth/command.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app{
      "Azimuth: replay, view, evaluate, compare, convert, import, export and simulate runs of a bearing-only SLAM "
      "robot; look "
      "after its machine.",
      "azimuth"};
  app.require_subcommand(1);
  azimuth::add_replay_command(app);
  azimuth::add_refine_command(app);
  azimuth::add_map_command(app);
  azimuth::add_evaluate_command(app);
  azimuth::add_compare_command(app);
  azimuth::add_simulate_command(app);
  azimuth::add_convert_command(app);
  azimuth::add_export_command(app);
  azimuth::add_import_command(app);
  azimuth::add_log_command(app);
  azimuth::add_check_command(app);
  azimuth::add_view_command(app);
  azimuth::add_doctor_command(app);
  azimuth::add_calibrate_command(app);
  azimuth::add_settings_command(app);
  azimuth::add_version_command(app);
  return azimuth::parse_command_line(app, argc, argv).value_or(azimuth::kDone);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const azimuth::CommandError& error) {
    azimuth::print_error(error.message);
    return error.code;
  } catch (const std::exception& error) {
    azimuth::print_error("azimuth: " + azimuth::visible(error.what()));
    return azimuth::kFailure;
  }
}
