#pragma once
#include <filesystem>

#include "drivers/storage/run.hpp"

namespace azimuth {

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
