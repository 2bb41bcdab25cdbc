#pragma once
// What subcommands that replay a run share: from the command line to the outcome.

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

/// Which run, and how the estimator is set up. Empty: not given.
struct ReplayOptions {
  std::filesystem::path run, config, truth, truth_folder;
  std::filesystem::path map;       ///< to start from; else that of the recording, if there is one
  std::filesystem::path pictures;  ///< folder to draw images into
  std::size_t every = 10;
  LogOptions log;
  std::string front_end;  ///< else the rig's
  std::vector<std::string> overrides;
  std::optional<int> seed;
  bool perceive = false;  ///< look at the images although bearings were recorded
  bool no_names = false;  ///< bearings carry none, whatever the rig says
  bool localise = false, quiet = false;
};

/// Adds --config, --set, --front-end and what else says what is replayed.
void add_run_options(CLI::App& command, ReplayOptions& options);
/// Adds `map_option`, for the map to start from, and --localise.
void add_start_map_options(CLI::App& command, ReplayOptions& options, const std::string& map_option);
/// Adds --truth and --truth-from.
void add_truth_options(CLI::App& command, ReplayOptions& options);

/// All that a replay begins with.
struct ReplaySetup {
  ReplayOptions options;
  Run run;
  Configuration configuration;
  Rig rig;
  std::optional<LoadedMap> map;

  bool uses_recorded_configuration() const;
};

/// Refuses what does not go together. With a `rig`, that stands in the place of the run's own, which need not have one.
ReplaySetup replay_setup(ReplayOptions options, const std::optional<Rig>& rig = {});

/// Shows its progress, and what was wrong with a map that was not used. The first: with the configured estimator.
ReplayResult replay_with(const ReplaySetup& setup, const ReplayWatch& watch = {});
ReplayResult replay_with(const ReplaySetup& setup, std::unique_ptr<Estimator> estimator, Ending ending,
                         const ReplayWatch& watch = {});

}  // namespace azimuth
