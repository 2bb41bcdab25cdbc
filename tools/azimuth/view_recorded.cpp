#include "tools/azimuth/view_recorded.hpp"

#include <cstdio>
#include <vector>

#include "drivers/storage/map_file.hpp"
#include "settings/configured_estimator.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/replay_outputs.hpp"
#include "tools/replay_page/map_page.hpp"
#include "tools/replay_page/page_run.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

bool is_map(const std::filesystem::path& file) { return file.extension() == ".azmap"; }

Json map_page(const std::filesystem::path& file) {
  const FileResult<LoadedMap> loaded = read_map(file);
  if (!loaded) refuse(loaded.error());
  if (!loaded->troubles.empty())
    std::fputs((text(loaded->troubles) + "; used " + shown(loaded->file) + '\n').c_str(), stderr);
  return page_of_map(loaded->map, file.filename().string());
}

/// The page of a run. A run that ends lost is shown, too.
Json run_page(const ViewOptions& options, const std::filesystem::path& file) {
  ReplayOptions given = options.replay;
  given.run = file;
  const ReplaySetup setup = replay_setup(given);
  HtmlOutput page(options.page, options.recordings.size());
  const ReplayResult result = replay_with(setup, page.watch(setup));
  const Report report = report_of(
      setup, result, name(chosen_estimator(setup.rig, setup.configuration, setup.map ? &setup.map->map : nullptr)), {});
  page.add(setup, result, report);
  if (page.runs().empty())
    refuse(file.string() + ": no step was made" +
           (report.input_trouble.empty() ? std::string() : ": " + report.input_trouble));
  return page.runs().front();
}

}  // namespace

std::string recorded_page(const ViewOptions& options) {
  std::vector<Json> runs;
  for (const std::filesystem::path& file : options.recordings)
    runs.push_back(is_map(file) ? map_page(file) : run_page(options, file));
  return page_data(runs, "azimuth " AZIMUTH_VERSION);
}

}  // namespace azimuth
