// azimuth map: works with saved maps. save makes a map from a recorded run, info describes a map, export writes it for
// other programs. merge and refine have files of their own.

#include <cstdio>
#include <memory>

#include "base/visible.hpp"
#include "drivers/storage/map_file.hpp"
#include "settings/configured_estimator.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/replay_outputs.hpp"
#include "tools/azimuth/replay_run.hpp"
#include "tools/map_export/map_texts.hpp"

namespace azimuth {
namespace {

void save_map(const ReplayOptions& options, const std::filesystem::path& file) {
  ReplayOutputs outputs;
  outputs.map = file;
  check_outputs(outputs);
  const ReplaySetup setup = replay_setup(options);
  const ReplayResult result = replay_with(setup);
  write_outputs(
      setup, result,
      report_of(setup, result,
                name(chosen_estimator(setup.rig, setup.configuration, setup.map ? &setup.map->map : nullptr)), outputs),
      outputs);
}

struct ExportOptions {
  std::filesystem::path file, out;
  std::string format = "geojson", origin;
};

void export_map(const ExportOptions& options) {
  std::optional<MapOrigin> origin;
  if (!options.origin.empty()) {
    if (options.format != "geojson") refuse("--origin: only GeoJSON has a place on the globe");
    origin = map_origin(options.origin);
    if (!origin)
      refuse("--origin " + options.origin +
             ": must be LAT,LON[,HEADING] in degrees, between 89 degrees south and north");
  }
  if (options.format == "geojson" && !origin)
    std::fputs(
        "coordinates are metres in the map's own frame, which the file says; --origin LAT,LON puts them on the "
        "globe\n",
        stderr);
  const LoadedMap loaded = load_map_or_refuse(options.file);
  const std::string text = options.format == "csv" ? map_csv(loaded.map) : map_geojson(loaded.map, origin);
  if (options.out.empty())
    std::fputs(text.c_str(), stdout);
  else
    write_text(text, options.out);
}

void add_save(CLI::App& map) {
  CLI::App* command = map.add_subcommand("save", "Run the estimator over a recorded run and save its final map");
  const auto options = std::make_shared<ReplayOptions>();
  const auto file = std::make_shared<std::filesystem::path>();
  command->add_option("RUN", options->run, kRunHelp)->required();
  add_run_options(*command, *options);
  add_start_map_options(*command, *options, "--from");
  command->add_option("--map", *file, "Map file to write; the earlier map is kept as FILE.previous")->required();
  command->callback([options, file] { save_map(*options, *file); });
}

void add_info(CLI::App& map) {
  CLI::App* command = map.add_subcommand("info", "Describe a map file; exit code 2: it cannot be read");
  const auto file = std::make_shared<std::filesystem::path>();
  const auto json = std::make_shared<bool>(false);
  command->add_option("FILE", *file, "Map file")->required();
  command->add_flag("--json", *json, "Print the description as one JSON object");
  command->callback([file, json] {
    const LoadedMap loaded = load_map_or_refuse(*file);
    std::fputs((*json ? map_summary_json(loaded) : visible_lines(map_summary(loaded))).c_str(), stdout);
  });
}

void add_export(CLI::App& map) {
  CLI::App* command = map.add_subcommand("export", "Write a map in a format that other programs read");
  const auto options = std::make_shared<ExportOptions>();
  command->add_option("FILE", options->file, "Map file")->required();
  command->add_option("--format", options->format, "Format to write: geojson or csv")
      ->check(CLI::IsMember({"geojson", "csv"}))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "File to write; without it standard output");
  command->add_option("--origin", options->origin,
                      "Place of the map's origin and heading of its x axis in GeoJSON, LAT,LON[,HEADING] in degrees, "
                      "heading clockwise from north; without it coordinates are metres in the map's frame (crs null)");
  command->callback([options] { export_map(*options); });
}

}  // namespace

void add_map_command(CLI::App& app) {
  CLI::App* map = app.add_subcommand("map", "Save, describe, export, merge and refine maps");
  map->require_subcommand(1);
  add_save(*map);
  add_info(*map);
  add_export(*map);
  add_map_merge_command(*map);
  add_map_refine_command(*map);
}

}  // namespace azimuth
