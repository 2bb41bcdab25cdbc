#pragma once
// What azimuth import was asked for, and its two ways. Internal to tools/azimuth.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/azimuth/unfinished_run.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {

struct ImportOptions {
  std::filesystem::path source, out, rig;
  bool force = false;
  Wheels wheels;
  std::string truth, images;  ///< a file and a folder beside a table; topics of a bag
  // Tables only.
  std::string columns, truth_columns, stamps = "name", stamps_columns, bearings_columns;
  std::filesystem::path bearings;
  // Bags only.
  std::vector<std::filesystem::path> parts;  ///< the files of SOURCE, in their order
  std::string odometry;
  std::vector<std::string> senders;  ///< of topics that several send: nodes, channels, or a frame of odometry
  std::string joints;                ///< LEFT,RIGHT: the names of the wheels
};

/// What import_tables() and import_bag() have in common: refuses an output that may not be written, or that is one of
/// the inputs.
void check_import(const ImportOptions& options);

/// Gives `run` its rig: that of --rig, else what is in the output folder already. One that has mistakes is refused.
void find_rig(const ImportOptions& options, Run& run);

/// Writes the run, and says what is in it, what is to be known of it (`sentences`), and what comes next.
void finish_import(const ImportOptions& options, const Run& run, const std::vector<std::string>& sentences,
                   UnfinishedRun& unfinished);

/// Shows how far something is, and ends it where Ctrl-C was pressed.
WriteProgress shown_and_interruptible(ProgressBar& bar);

/// Tables of other programs, and folders of images.
void import_tables(const ImportOptions& options);

/// Bags of ROS; without an output, what is in one.
void import_bag(const ImportOptions& options);

}  // namespace azimuth
