#pragma once
#include <filesystem>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// Whether a run is written as an LCM log: its name ends in .lcmlog, .lcm or .log. Any other name is a run folder.
bool is_log_name(const std::filesystem::path& out);

/// Refuses an output that exists already, unless `force` is set. An empty folder is accepted.
void check_output(const std::filesystem::path& out, bool force);

/// Refuses the name of a picture whose ending is not a supported format.
void check_picture_name(const std::filesystem::path& file);

/// Fails if a file could not be written, so that nobody waits for a result that is then lost. The check leaves no file
/// behind and does not change an existing file. It ignores an empty path, and anything that is not a regular file.
void check_writable(const std::filesystem::path& file);

/// Writes the run in the form that the name asks for. A log is replaced only as a whole: if writing fails or `progress`
/// throws, the earlier log stays.
void write_run(const Run& run, const std::filesystem::path& out, const WriteProgress& progress = {});

/// A run that is being written. If the program ends before finish(), the destructor removes the new files and leaves
/// earlier files as they were.
///
/// Thread contract: thread-bound.
class UnfinishedRun {
 public:
  /// `out` is the path for write_run().
  explicit UnfinishedRun(std::filesystem::path out);
  ~UnfinishedRun();
  UnfinishedRun(const UnfinishedRun&) = delete;
  UnfinishedRun& operator=(const UnfinishedRun&) = delete;

  /// Temporary folder for the image files, with the names that they get in `out` when the run is finished.
  const std::filesystem::path& files() const { return files_; }

  /// Moves the files into the run and writes it. Fails as write_run() does.
  void finish(const Run& run, const WriteProgress& progress = {});

 private:
  std::filesystem::path out_, files_;
  bool was_there_;
  bool finished_ = false;
};

}  // namespace azimuth
