#pragma once
// Output files of the simulator, for comparison of a daemon with the truth.

#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/storage/run.hpp"
#include "sim/azimuth_sim/paced_clock.hpp"
#include "sim/azimuth_sim/simulation.hpp"

namespace azimuth::sim {

/// Names of the output files. A file with an empty name is not written.
struct RunFileNames {
  std::filesystem::path truth;       ///< truth.csv in the format of run folders
  std::filesystem::path sip_log;     ///< Columns: t_latch_s,x_raw,y_raw,heading_raw
  std::filesystem::path run_folder;  ///< rig.toml, landmarks.csv, truth.csv, and the samples of ideal devices
};

/// Writes the output files, with the stamps that a daemon on this machine would give. The two tables are written line
/// by line. The run folder is written at the start, without samples, and again at the end.
///
/// Thread contract: thread-bound.
class RunFiles {
 public:
  /// `rig_text` is the rig.toml of the run folder; if it is empty, that of the scenario, whose camera gives bearings.
  static FileResult<RunFiles> create(const RunFileNames& names, const Scenario& scenario, std::string rig_text = {});

  void add(const SimulationOutput& output, const PacedClock& clock);
  /// Completes the files; returns the errors of writing.
  [[nodiscard]] FileResult<void> finish();

 private:
  explicit RunFiles(RunFileNames names) : names_(std::move(names)) {}
  [[nodiscard]] FileResult<void> open_tables();
  void remember(const SimulationOutput& output, const PacedClock& clock);

  RunFileNames names_;
  std::ofstream truth_, sip_log_;
  Run run_;
};

}  // namespace azimuth::sim
