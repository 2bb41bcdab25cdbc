#pragma once
// Replay of a run, from the command line to the result, shared by the subcommands.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/storage/map_file.hpp"
#include "drivers/storage/run.hpp"
#include "settings/configuration.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The run to replay and the setup of the estimator. An empty member is not given.
struct ReplayOptions {
  std::filesystem::path run, config, truth, truth_folder;
  std::filesystem::path map;       ///< map to start from; empty: the map of the recording, if any
  std::filesystem::path pictures;  ///< folder to draw images into
  std::size_t every = 10;
  LogOptions log;
  std::string front_end;  ///< empty: the rig's front end
  std::vector<std::string> overrides;
  std::optional<int> seed;
  bool perceive = false;  ///< use the images although bearings were recorded
  bool no_names = false;  ///< ignore the names of bearings, whatever the rig says
  bool localise = false, quiet = false;
};

/// Adds --config, --set, --front-end and the other options of a replay.
void add_run_options(CLI::App& command, ReplayOptions& options);
/// Adds `map_option`, for the map to start from, and --localise.
void add_start_map_options(CLI::App& command, ReplayOptions& options, const std::string& map_option);
/// Adds --truth and --truth-from.
void add_truth_options(CLI::App& command, ReplayOptions& options);

/// Everything that a replay needs.
struct ReplaySetup {
  ReplayOptions options;
  Run run;
  Configuration configuration;
  Rig rig;
  std::optional<LoadedMap> map;

  bool uses_recorded_configuration() const;
};

/// Reads everything that a replay needs, and refuses options that contradict each other or the run. A given `rig`
/// replaces the run's rig, which may then be missing.
ReplaySetup replay_setup(ReplayOptions options, const std::optional<Rig>& rig = {});

/// Replays the run with the configured or the given estimator. Shows the progress, and prints the errors of maps that
/// could not be used.
ReplayResult replay_with(const ReplaySetup& setup, const ReplayWatch& watch = {});
ReplayResult replay_with(const ReplaySetup& setup, std::unique_ptr<Estimator> estimator, Ending ending,
                         const ReplayWatch& watch = {});

}  // namespace azimuth
