#pragma once
// The options of azimuth import, and the imports of tables and bags. Internal to tools/azimuth.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {

struct ImportOptions {
  std::filesystem::path source, out, rig;
  bool force = false;
  Wheels wheels;
  std::string truth, images;  ///< with a table: a file and a folder; with a bag: topics
  // Tables only.
  std::string columns, truth_columns, stamps = "name", stamps_columns, bearings_columns;
  std::filesystem::path bearings;
  // Bags only.
  std::vector<std::filesystem::path> parts;  ///< the files of SOURCE, in their order
  std::string odometry;
  std::vector<std::string> senders;  ///< senders to choose: nodes, channels, or a frame of odometry
  std::string joints;                ///< LEFT,RIGHT: the names of the wheels
  LogOptions log;                    ///< the channels of an LCM log
};

/// Refuses an output that must not be written, or that is one of the inputs.
void check_import(const ImportOptions& options);

/// Gives `run` its rig, from --rig or else from the output folder. Refuses a rig with mistakes.
void find_rig(const ImportOptions& options, Run& run);

/// Writes the run, and prints its content, the notes in `sentences`, and the next command.
void finish_import(const ImportOptions& options, const Run& run, const std::vector<std::string>& sentences,
                   UnfinishedRun& unfinished);

/// Shows the progress on the bar, and throws once Ctrl-C was pressed.
WriteProgress shown_and_interruptible(ProgressBar& bar);

/// Imports tables of other programs, and folders of images.
void import_tables(const ImportOptions& options);

/// Imports a ROS bag. Without an output it lists the bag's topics.
void import_bag(const ImportOptions& options);

}  // namespace azimuth
